//! Boards that run here for the page: with the code of their controllers and the programs of their world, which a page
//! by itself cannot have.
//!
//! In: the calls that a page would give its own module, each with the name that the page gave the board. Out: that
//! module's answers. A board has a thread, which ends with the board.

use std::collections::BTreeMap;
use std::io::Read as _;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

use sensedsl_diagnostics::Diagnostic;
use sensedsl_diagnostics::codes::{e0535_user_code_not_built, e0536_user_code_stopped};
use sensedsl_job::BoardJob;
use sensedsl_limits::TOTAL_BYTES_MAX;
use sensedsl_twin::bench::Bench;
use sensedsl_twin::soft::UserCode;
use sensedsl_twin::world::World;
use sensedsl_web::{Outside, ServedBoard};
use serde_json::Value;
use tiny_http::Request;

use super::answer::Answer;
use super::folder::is_inside;
use crate::commands::input;
use crate::commands::simulate::{Running, Words, attach_all, build, usual_code};

/// The most boards at once; a further one takes the place of the oldest.
const BOARDS_MAX: usize = 4;
/// A board that nobody calls for so long ends: its page was closed.
const ALONE: Duration = Duration::from_secs(15 * 60);

/// A call, and where its answer goes.
type Call = (String, Sender<String>);

/// The boards that run, by the names that pages gave them, with the order in which they came.
pub(super) struct Boards {
    root: PathBuf,
    all: Mutex<BTreeMap<String, (u64, Sender<Call>)>>,
}

impl Boards {
    /// For the designs of a folder.
    pub(super) fn of(root: &Path) -> Self {
        Self { root: root.to_path_buf(), all: Mutex::default() }
    }

    /// Gives a board a call, and waits for what it says.
    pub(super) fn answer(&self, name: &str, request: &mut Request) -> Answer {
        let call = match text_of(request) {
            Ok(call) => call,
            Err(refused) => return refused,
        };
        let (sender, answer) = channel();
        let told = self.board(name, &call).and_then(|board| {
            board.send((call, sender)).ok()?;
            answer.recv().ok()
        });
        match told {
            Some(told) => Answer::json_text(told),
            None => {
                self.end(name);
                Answer::refused(410, "the board has ended: start it again")
            }
        }
    }

    /// Ends a board.
    pub(super) fn end(&self, name: &str) {
        self.all.lock().unwrap_or_else(PoisonError::into_inner).remove(name);
    }

    /// The board of that name; a call that starts one makes it, any other comes too late.
    fn board(&self, name: &str, call: &str) -> Option<Sender<Call>> {
        let mut all = self.all.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, board)) = all.get(name) {
            return Some(board.clone());
        }
        let call: Value = serde_json::from_str(call).ok()?;
        if call.get("do").and_then(Value::as_str) != Some("robot") {
            return None;
        }
        while all.len() >= BOARDS_MAX {
            let oldest = all.iter().min_by_key(|(_, (came, _))| *came);
            let Some(oldest) = oldest.map(|(name, _)| name.clone()) else { break };
            all.remove(&oldest);
        }
        let came = all.values().map(|(came, _)| came + 1).max().unwrap_or(0);
        let (sender, calls) = channel();
        let root = self.root.clone();
        std::thread::spawn(move || run(root, &calls));
        all.insert(name.to_owned(), (came, sender.clone()));
        Some(sender)
    }
}

/// A board's thread.
fn run(root: PathBuf, calls: &Receiver<Call>) {
    let mut board = ServedBoard::beside(Box::new(Computer { root }));
    while let Ok((call, answer)) = calls.recv_timeout(ALONE) {
        // Who asked may have gone.
        let _ = answer.send(board.call(&call));
    }
}

/// The call that a page sends.
fn text_of(request: &mut Request) -> Result<String, Answer> {
    // Escapes make a text longer.
    let most = 2 * TOTAL_BYTES_MAX as u64;
    let mut text = String::new();
    match request.as_reader().take(most + 1).read_to_string(&mut text) {
        Ok(_) if text.len() as u64 > most => Err(Answer::refused(413, "the call is too large")),
        Ok(_) => Ok(text),
        Err(_) => Err(Answer::refused(400, "the call was cut off, or is not UTF-8")),
    }
}

/// This computer, with its compiler and the files of the folder.
struct Computer {
    root: PathBuf,
}

impl Outside for Computer {
    fn code(
        &self,
        design: &str,
        job: &BoardJob<'_>,
    ) -> Result<Option<Box<dyn UserCode>>, Box<Diagnostic>> {
        let folder = usual_code(&self.root.join(design), &job.board.name.value);
        if job.controllers.is_empty() || !is_inside(design) || !folder.is_dir() {
            return Ok(None);
        }
        let at = input::place(job.design);
        let built = build(job, &folder, at, Words::Within).unwrap_or_else(|why| {
            let why = format!("{why:#}");
            Err(e0535_user_code_not_built::user_code_not_built(at, &why).into())
        })?;
        match Running::new(built) {
            Ok(running) => Ok(Some(Box::new(running))),
            Err(why) => Err(e0536_user_code_stopped::user_code_stopped(at, "0 s", &why).into()),
        }
    }

    fn attach(&self, bench: &mut Bench, world: &World, path: &str) {
        let path = self.root.join(path);
        attach_all(bench, world, path.parent().unwrap_or(&self.root));
    }
}
