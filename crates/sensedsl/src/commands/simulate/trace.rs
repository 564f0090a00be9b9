//! What `--trace` writes: a simulated run as a record, like one of a board, in virtual time from 0 on. So the same run
//! gives the same bytes.

use std::io::Cursor;
use std::path::PathBuf;
use std::time::Duration;

use anyhow::{Context as _, Result, bail};
use sensedsl_host::{Board, Moment, News, Report, What};
use sensedsl_record::Recorder;
use sensedsl_wire::Scalar;

use super::simulation::Simulation;
use crate::files::{shown, write_whole};

/// A record of a run that can be had again: it is written at the end, over an older one.
pub(super) struct Trace {
    path: PathBuf,
    board: Board,
    recorder: Recorder<Cursor<Vec<u8>>>,
    is_online: bool,
    /// The first thing that went wrong.
    failed: Option<std::io::Error>,
}

impl Trace {
    /// Makes the file; `None` if none is asked for.
    pub(super) fn begin(scenery: &Simulation<'_>) -> Result<Option<Self>> {
        let Some((path, schema)) = scenery.args.trace.as_ref().zip(scenery.schema_json.as_ref())
        else {
            return Ok(None);
        };
        let name = &scenery.job.board.name.value;
        let boards = Board::all_of_json(schema).context("the schema cannot be read")?;
        let Some(board) = boards.into_iter().find(|board| board.name == *name) else {
            bail!("the schema lacks {name}");
        };
        let to = Cursor::new(Vec::new());
        let recorder = Recorder::new(to, schema, std::slice::from_ref(&board), Moment::default())
            .context("the record cannot be begun")?;
        Ok(Some(Self { path: path.clone(), board, recorder, is_online: false, failed: None }))
    }

    /// The board has reported.
    pub(super) fn report(&mut self, now_ns: u64, values: &[(u8, Vec<Scalar>)]) {
        if !std::mem::replace(&mut self.is_online, true) {
            self.take(now_ns, What::Online);
        }
        let place = |id: u8| self.board.devices.iter().position(|one| one.id == id);
        let values = values.iter().filter_map(|(id, value)| Some((place(*id)?, value.clone())));
        let report = Report { stamp: None, latency: None, values: values.collect() };
        self.take(now_ns, What::Report(&report));
    }

    /// An actuator was set, by the host or by code on the board.
    pub(super) fn set(&mut self, now_ns: u64, id: u8, value: &[Scalar]) {
        if let Some(device) = self.board.devices.iter().position(|one| one.id == id) {
            self.take(now_ns, What::Command { device, value });
        }
    }

    fn take(&mut self, now_ns: u64, what: What<'_>) {
        let run = Duration::from_nanos(now_ns);
        let news = News { board: 0, at: Moment { run, unix: run }, what };
        if self.failed.is_none() {
            self.failed = self.recorder.take(&news).err();
        }
    }

    /// Ends the record.
    pub(super) fn end(self) -> Result<()> {
        let what = || format!("cannot write {}", shown(&self.path));
        if let Some(failed) = self.failed {
            return Err(failed).with_context(what);
        }
        let bytes = self.recorder.finish().with_context(what)?.into_inner();
        write_whole(&self.path, &bytes)
    }
}
