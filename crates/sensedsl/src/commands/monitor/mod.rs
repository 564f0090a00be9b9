//! `sensedsl monitor`: the values of boards as they come, and commands to them.
//!
//! `subject.rs` says which boards are meant, `find.rs` where they are, `source.rs` has the bytes of one, `link.rs` what
//! is known of it. `watch.rs` is the loop between links and those who are told: a *face* for people (`face.rs`), which
//! prints (`show.rs`) or has the whole terminal (`screen`), and outputs (`outputs.rs`): a record (`record.rs`), which
//! `replay.rs` plays again, a pseudo-terminal (`pty.rs`), other programs (`sinks.rs`). Whether a board is the one that
//! is meant decides `sensedsl_host::Session`.

mod face;
mod find;
mod link;
mod outputs;
#[cfg(unix)]
mod pty;
mod record;
mod replay;
mod rules;
mod screen;
mod show;
mod sinks;
mod source;
mod subject;
mod watch;
mod words;

use std::path::Path;

use anyhow::{Result, bail};
use sensedsl_diagnostics::Diagnostic;
use sensedsl_diagnostics::codes::e0557_no_board as no_board;
use sensedsl_diagnostics::codes::e0565_not_a_record::other_boards;
use sensedsl_host::Board;

use crate::cli::{MonitorArgs, MonitorFormat};
use crate::files::Refused;
use crate::status::Status;
use crate::terminal::Terminal;
use face::Face;
pub(super) use find::cure;
use find::{found, is_recording, open, who};
use link::Link;
use replay::Replay;
use rules::{Requirements, Rules};
use screen::Screen;
use show::{Printer, format};
use source::Source;
use subject::Subject;
use watch::Watch;

pub(crate) fn run(args: &MonitorArgs, terminal: &Terminal) -> Result<Status> {
    if let Some(path) = args.record_file() {
        return replayed(path, args, terminal);
    }
    let (device, file) = places(args);
    if let Some(to) = &args.sinks.init_config {
        return sinks::init(args, file.or(device.map(Path::new)), to.as_deref(), terminal);
    }
    if let (Some("simulate"), Some(file)) = (device, file) {
        return subject::simulated(args, file, terminal, |subject, found| {
            watch(args, terminal, subject, found, None)
        });
    }
    if args.world.is_some() {
        bail!("`--world` is for a simulated board: `sensedsl monitor simulate FILE --world …`");
    }
    let subject = subject::read(args, file, terminal)?;
    let Some(wanted) = subject.wanted(args, terminal)? else { return Ok(Status::Misused) };
    let found = match device {
        Some("simulate") => Err(Box::new(no_board::no_design(subject.at))),
        Some(path) => one(path, args, &subject, &wanted, terminal)?,
        None if args.at.is_empty() => Ok(found(args, terminal, &subject, wanted)?),
        None => Ok(Vec::new()),
    };
    let at = args.at.iter().map(|(name, path)| named(name, path, args, &subject, terminal));
    let at: Result<Vec<Option<(&Board, Source)>>> = at.collect();
    match found {
        Ok(mut found) => {
            let Some(at) = at?.into_iter().collect::<Option<Vec<_>>>() else {
                return Ok(Status::Misused);
            };
            found.extend(at);
            watch(args, terminal, &subject, found, None)
        }
        Err(why) => {
            terminal.diagnostics(&[*why], &subject.sources)?;
            Ok(Status::Misused)
        }
    }
}

/// The device and the file: a single place that is a `.sense` file is the file.
fn places(args: &MonitorArgs) -> (Option<&str>, Option<&Path>) {
    let device = args.device.as_deref();
    let is_file = device.is_some_and(|one| one.ends_with(".sense"));
    match &args.file {
        None if is_file && args.schema.is_none() => (None, device.map(Path::new)),
        file => (device, file.as_deref()),
    }
}

type Found<'s> = Vec<(&'s Board, Source)>;

/// The board at a path: the one that is wanted, or of several the one that answers.
fn one<'s>(
    path: &str,
    args: &MonitorArgs,
    subject: &'s Subject,
    wanted: &[&'s Board],
    terminal: &Terminal,
) -> Result<Result<Found<'s>, Box<Diagnostic>>> {
    let Some(first) = wanted.first() else { return Ok(Ok(Vec::new())) };
    if is_recording(path) {
        subject.hint(args, terminal)?;
        let source = Source::recording(path);
        let refused = |error: std::io::Error| {
            Box::new(no_board::unreadable(subject.at, path, &error.to_string()))
        };
        return Ok(source.map(|source| vec![(*first, source)]).map_err(refused));
    }
    let baud = args.baud.or(first.baud);
    let port = match open(path, baud, subject) {
        Ok(port) => port,
        Err(why) => return Ok(Err(why)),
    };
    if wanted.len() == 1 {
        return Ok(Ok(vec![(*first, Source::Port(port))]));
    }
    Ok(match who(port, wanted) {
        Ok((board, port)) => {
            terminal.aside(&format!("`{}` is at {path}", board.name))?;
            Ok(vec![(board, Source::Port(port))])
        }
        Err(why) => Err(Box::new(no_board::none_found(subject.at, &[format!("{path}: {why}")]))),
    })
}

/// The board of a name at a path that the arguments give; none if either is not there, which was told.
fn named<'s>(
    name: &str,
    path: &str,
    args: &MonitorArgs,
    subject: &'s Subject,
    terminal: &Terminal,
) -> Result<Option<(&'s Board, Source)>> {
    let Some(board) = subject.named(name, terminal)? else { return Ok(None) };
    match open(path, args.baud.or(board.baud), subject) {
        Ok(port) => Ok(Some((board, Source::Port(port)))),
        Err(why) => {
            terminal.diagnostics(&[*why], &subject.sources)?;
            Ok(None)
        }
    }
}

/// What people see: a screen where they see it as it is written, otherwise printed values.
fn face<'a>(args: &MonitorArgs, terminal: &'a Terminal, links: &[Link<'a>]) -> Box<dyn Face + 'a> {
    let mut format = format(args, terminal);
    if format == MonitorFormat::Table && terminal.is_watched() {
        let boards = links.iter().map(|link| link.board).collect();
        match terminal.has_pages().then(|| Screen::open(terminal, boards)) {
            Some(Ok(screen)) => return Box::new(screen),
            // Nobody can press keys: values are seen as they come.
            Some(Err(_)) | None => format = MonitorFormat::Lines,
        }
    }
    Box::new(Printer::new(args, terminal, format))
}

/// Plays a record; a design or schema beside it says which boards are meant, and is compared by its hash.
fn replayed(path: &Path, args: &MonitorArgs, terminal: &Terminal) -> Result<Status> {
    let mut replay = Replay::open(path)?;
    let (_, file) = places(args);
    let subject = match (&args.schema, file) {
        (None, None) => subject::of_record(&replay),
        _ => subject::read(args, file, terminal)?,
    };
    let Some(wanted) = subject.wanted(args, terminal)? else { return Ok(Status::Misused) };
    let recorded: Vec<&str> = replay.boards().iter().map(|board| board.name.as_str()).collect();
    let watched: Vec<&Board> =
        wanted.iter().copied().filter(|board| recorded.contains(&board.name.as_str())).collect();
    let (Some(first), true) = (wanted.first(), watched.is_empty()) else {
        replay.of(&watched);
        let found = watched.into_iter().map(|board| (board, Source::Replayed)).collect();
        return watch(args, terminal, &subject, found, Some(replay));
    };
    bail!(Refused::new(path, |at, shown| other_boards(at, shown, &first.name, &recorded)))
}

fn watch(
    args: &MonitorArgs,
    terminal: &Terminal,
    subject: &Subject,
    found: Found<'_>,
    replay: Option<Replay>,
) -> Result<Status> {
    let config = sinks::read(&args.sinks, terminal, subject)?;
    let mut links: Vec<Link<'_>> =
        found.into_iter().map(|(board, source)| Link::new(args, board, source)).collect();
    if links.len() > 1 {
        links.iter_mut().for_each(Link::name_board);
    }
    let required =
        args.watch.as_ref().map(|path| Requirements::read(path, args, terminal)).transpose()?;
    let boards = || links.iter().map(|link| link.board.clone()).collect();
    let rules = required.as_ref().map(|required| required.rules(boards()));
    let face = face(args, terminal, &links);
    let is_asked = face.has_terminal() || rules.as_ref().is_some_and(Rules::asks_for_health);
    if is_asked && args.health.is_none() {
        links.iter_mut().for_each(Link::show_health);
    }
    let mut watch = Watch::new(args, terminal, subject, links, face, replay, config);
    watch.rules = rules;
    watch.run()
}
