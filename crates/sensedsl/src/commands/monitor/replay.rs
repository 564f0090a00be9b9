//! A record that is played again: the same news at the same pace, a faster one, or as fast as it can be shown.

use std::path::{Path, PathBuf};
use std::sync::mpsc::SyncSender;
use std::time::{Duration, Instant};

use sensedsl_host::{Board, Moment};
use sensedsl_record::Ending;

use super::source::Heard;
use crate::cli::Speed;
use crate::files::{RecordFile, Refused, open_record};

/// The longest pause in one go: between two, the thread sees whether anybody still listens.
const PAUSE_MAX: Duration = Duration::from_millis(200);

/// A record that was opened.
pub(super) struct Replay {
    reader: RecordFile,
    pub(super) path: PathBuf,
    pub(super) begin: Moment,
    /// The place of each board of the record among those that are watched.
    links: Vec<Option<usize>>,
}

impl Replay {
    pub(super) fn open(path: &Path) -> Result<Self, Refused> {
        let reader = open_record(path)?;
        let begin = reader.begin();
        let links = vec![None; reader.boards().len()];
        Ok(Self { reader, path: path.to_owned(), begin, links })
    }

    pub(super) fn boards(&self) -> &[Board] {
        self.reader.boards()
    }

    pub(super) fn schema_json(&self) -> &str {
        self.reader.schema_json()
    }

    /// Takes the boards of the record that are watched, in their order.
    pub(super) fn of(&mut self, watched: &[&Board]) {
        let place = |board: &Board| watched.iter().position(|one| one.name == board.name);
        self.links = self.reader.boards().iter().map(place).collect();
    }

    /// Plays it in a thread.
    pub(super) fn play(mut self, speed: Speed, to_loop: SyncSender<Heard>) {
        let _ = std::thread::spawn(move || {
            let end = self.run(speed, &to_loop);
            if let Some(end) = end {
                let _ = to_loop.send(Heard::PastOver(end));
            }
        });
    }

    /// How it ended; none if nobody listens any more.
    fn run(&mut self, speed: Speed, to_loop: &SyncSender<Heard>) -> Option<Result<Ending, String>> {
        let began = Instant::now();
        loop {
            let entry = match self.reader.next_entry() {
                Ok(Some(entry)) => entry,
                Ok(None) => return Some(Ok(self.reader.ending().unwrap_or(Ending::Whole))),
                Err(why) => return Some(Err(why.to_string())),
            };
            if let Speed::Times(times) = speed {
                let due = began + entry.at.run.div_f64(times);
                while let Some(left) = due.checked_duration_since(Instant::now()) {
                    std::thread::sleep(left.min(PAUSE_MAX));
                }
            }
            let Some(link) = self.links.get(entry.board).copied().flatten() else { continue };
            to_loop.send(Heard::Past { link, at: entry.at, what: entry.what }).ok()?;
        }
    }
}
