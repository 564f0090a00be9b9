//! What `--record` writes: the run as a file, and what is told if that does not work any more.

use std::io;
use std::path::{Path, PathBuf};

use sensedsl_diagnostics::codes::e0566_no_new_record::ends_here;
use sensedsl_host::{Board, Moment, News, Output, Wish};
use sensedsl_record::Recorder;

use crate::files::{Growing, shown};

/// A record that is being written.
pub(super) struct Recording {
    path: PathBuf,
    recorder: Option<Recorder<Growing>>,
    trouble: Option<Wish>,
}

impl Recording {
    /// Makes the file.
    pub(super) fn new(
        path: &Path,
        schema_json: &str,
        boards: &[Board],
        now: Moment,
    ) -> io::Result<Self> {
        let file = Growing::create(path)?;
        let recorder = Recorder::new(file, schema_json, boards, now)?;
        Ok(Self { path: path.to_owned(), recorder: Some(recorder), trouble: None })
    }

    /// Keeps what went wrong for people; what was written so far stays.
    fn settle(&mut self, done: io::Result<()>) {
        let Err(error) = done else { return };
        self.recorder = None;
        let (file, why) = (shown(&self.path), error);
        self.trouble = Some(Wish::Trouble {
            what: ends_here(&file, &why.to_string()),
            help: "what was written until now can be read; make room and begin another one"
                .to_owned(),
        });
    }
}

impl Output for Recording {
    fn take(&mut self, news: &News<'_>) {
        let done = self.recorder.as_mut().map(|recorder| recorder.take(news));
        self.settle(done.unwrap_or(Ok(())));
    }

    fn look(&mut self, now: Moment) -> Vec<Wish> {
        let done = self.recorder.as_mut().map(|recorder| recorder.close_chunk(now.run));
        self.settle(done.unwrap_or(Ok(())));
        self.trouble.take().into_iter().collect()
    }

    fn close(&mut self, _: Moment) -> Vec<Wish> {
        if let Some(recorder) = self.recorder.take() {
            let done = recorder.finish().and_then(Growing::finish);
            self.settle(done);
        }
        self.trouble.take().into_iter().collect()
    }
}
