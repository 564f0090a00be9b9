//! Which boards are meant: a design, or its generated `schema.json`, in, boards out.

use std::path::Path;

use anyhow::{Result, bail};
use sensedsl_diagnostics::codes::e0556_not_a_schema::not_a_schema;
use sensedsl_diagnostics::codes::{e0519_which_board, e0557_no_board as no_board};
use sensedsl_diagnostics::{FileId, SourceMap, Span};
use sensedsl_host::Board;
use sensedsl_job::{BoardJob, jobs};
use sensedsl_model::FileUse;
use sensedsl_model::design::{Design, DeviceIndex};
use sensedsl_report::schema::schema;
use sensedsl_session::{Answer, Ask, Snapshot, has_errors};
use sensedsl_wiring::assignment::Assignment;

use super::replay::Replay;
use super::source::Source;
use crate::cli::{MonitorArgs, On, SimulateArgs};
use crate::commands::input;
use crate::commands::simulate::Simulated;
use crate::files::{Refused, read_text};
use crate::status::{Reported, Status};
use crate::terminal::Terminal;

/// The boards that a link may be of.
pub(super) struct Subject {
    pub(super) boards: Vec<Board>,
    /// The text that describes them.
    pub(super) schema_json: String,
    pub(super) sources: SourceMap,
    /// The place for diagnostics about the whole.
    pub(super) at: Span,
}

impl Subject {
    /// The boards that are wanted: the one that the arguments name, or all; none if there is no such board, which was
    /// told.
    pub(super) fn wanted(
        &self,
        args: &MonitorArgs,
        terminal: &Terminal,
    ) -> Result<Option<Vec<&Board>>> {
        match &args.board {
            Some(name) => Ok(self.named(name, terminal)?.map(|board| vec![board])),
            None => Ok(Some(self.boards.iter().collect())),
        }
    }

    /// The board of that name; none if there is no such board, which was told.
    pub(super) fn named(&self, name: &str, terminal: &Terminal) -> Result<Option<&Board>> {
        let found = self.boards.iter().find(|board| board.name == name);
        if found.is_none() {
            let names: Vec<&str> = self.boards.iter().map(|board| board.name.as_str()).collect();
            let why = e0519_which_board::not_in_file(self.at, name, &names);
            terminal.diagnostics(&[why], &self.sources)?;
        }
        Ok(found)
    }

    /// Says which other boards a recording may be of.
    pub(super) fn hint(&self, args: &MonitorArgs, terminal: &Terminal) -> Result<()> {
        let names: Vec<&str> = self.boards.iter().map(|board| board.name.as_str()).collect();
        if let [_, others @ ..] = names.as_slice()
            && !others.is_empty()
            && args.board.is_none()
        {
            terminal.aside(&format!("`--board` is another one: {}", others.join(", ")))?;
        }
        Ok(())
    }
}

/// Reads the design or its schema.
pub(super) fn read(
    args: &MonitorArgs,
    file: Option<&Path>,
    terminal: &Terminal,
) -> Result<Subject> {
    let subject = match (&args.schema, file) {
        (Some(path), _) => of_schema(path)?,
        (None, Some(path)) => of_design(args, path, terminal)?,
        (None, None) => {
            let mut sources = SourceMap::default();
            let at = Span::new(sources.add("monitor", ""), 0..0);
            terminal.diagnostics(&[no_board::no_design(at)], &sources)?;
            bail!(Reported(Status::Misused));
        }
    };
    if subject.boards.is_empty() {
        terminal.diagnostics(&[no_board::nothing_on_it(subject.at)], &subject.sources)?;
        bail!(Reported(Status::Wrong));
    }
    Ok(subject)
}

fn of_schema(path: &Path) -> Result<Subject> {
    let text = read_text(path, FileUse::Schema)?;
    match Board::all_of_json(&text) {
        Ok(boards) => {
            let mut sources = SourceMap::default();
            let at = start(sources.add(crate::files::shown(path), text.as_str()));
            Ok(Subject { boards, schema_json: text, sources, at })
        }
        Err(why) => {
            bail!(Refused::new(path, |at, shown| not_a_schema(at, shown, &why.to_string())))
        }
    }
}

/// The boards that a record describes.
pub(super) fn of_record(replay: &Replay) -> Subject {
    let mut sources = SourceMap::default();
    let at = start(sources.add(crate::files::shown(&replay.path), ""));
    Subject {
        boards: replay.boards().to_vec(),
        schema_json: replay.schema_json().to_owned(),
        sources,
        at,
    }
}

fn start(file: FileId) -> Span {
    Span::new(file, 0..0)
}

fn on(args: &MonitorArgs) -> On {
    On { board: None, target: None, reach: args.reach.clone() }
}

/// The boards of a design: which devices are on which may depend on the wiring.
fn of_design(args: &MonitorArgs, path: &Path, terminal: &Terminal) -> Result<Subject> {
    let on = on(args);
    let snapshot = input::load(path, &on);
    let answer = snapshot.solve(&Ask::default());
    let wired = wired(&answer, &snapshot, &on, terminal)?;
    subject(wired, snapshot.sources())
}

/// The design and its wiring; what is wrong with them was told.
fn wired<'a>(
    answer: &'a Answer<'_>,
    snapshot: &Snapshot,
    on: &On,
    terminal: &Terminal,
) -> Result<(&'a Design, &'a Assignment)> {
    let wired = input::wired(answer, snapshot, on, terminal)?;
    if has_errors(&answer.diagnostics) {
        terminal.diagnostics(&answer.diagnostics, snapshot.sources())?;
        bail!(Reported(Status::Wrong));
    }
    Ok(wired)
}

/// What is written here is what is read there: `generate` gives the same text to other programs.
fn subject((design, wiring): (&Design, &Assignment), sources: &SourceMap) -> Result<Subject> {
    let schema_json = schema(design, wiring).to_string();
    let boards = Board::all_of_json(&schema_json)?;
    Ok(Subject { boards, schema_json, sources: sources.clone(), at: input::place(design) })
}

/// Runs boards in this program, and what is to be done with them.
pub(super) fn simulated(
    args: &MonitorArgs,
    path: &Path,
    terminal: &Terminal,
    watch: impl FnOnce(&Subject, Vec<(&Board, Source)>) -> Result<Status>,
) -> Result<Status> {
    let on = on(args);
    let snapshot = input::load(path, &on);
    let answer = snapshot.solve(&Ask::default());
    let (design, wiring) = wired(&answer, &snapshot, &on, terminal)?;
    let subject = subject((design, wiring), snapshot.sources())?;
    let Some(wanted) = subject.wanted(args, terminal)? else { return Ok(Status::Misused) };
    let all: Vec<BoardJob<'_>> = jobs(design, wiring).collect();
    let simulation = SimulateArgs {
        world: args.world.clone(),
        reach: args.reach.clone(),
        ..SimulateArgs::default()
    };
    let of = |board: &Board| all.iter().find(|job| job.board.name.value == board.name);
    let jobs: Vec<_> = wanted.into_iter().filter_map(|board| Some((board, of(board)?))).collect();
    let devices = jobs.iter().flat_map(|(_, job)| &job.devices);
    let devices: Vec<DeviceIndex> = devices.map(|one| one.index).collect();
    let mut found = Vec::new();
    for (board, job) in jobs {
        let Some(simulated) = Simulated::new(job, &devices, &simulation, terminal)? else {
            return Ok(Status::Wrong);
        };
        found.push((board, Source::Simulated(Box::new(simulated))));
    }
    if found.is_empty() {
        terminal.diagnostics(&[no_board::nothing_on_it(subject.at)], &subject.sources)?;
        return Ok(Status::Wrong);
    }
    watch(&subject, found)
}
