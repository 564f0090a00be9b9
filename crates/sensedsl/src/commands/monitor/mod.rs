//! `sensedsl monitor`: the values of a board as they come, and commands to it.
//!
//! `subject.rs` says which boards are meant, `source.rs` where bytes come from, `watch.rs` is the loop between them and
//! `show.rs`. Whether the board is the one that is meant decides `sensedsl_host::Session`.

mod show;
mod source;
mod subject;
mod watch;

use std::path::Path;

use anyhow::Result;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_diagnostics::codes::e0557_no_board as no_board;
use sensedsl_host::Board;
use sensedsl_host::port::{OpenError, Port, usb_ports};

use crate::cli::MonitorArgs;
use crate::files::shown;
use crate::status::{Reported, Status};
use crate::terminal::Terminal;
use source::Source;
use subject::Subject;
use watch::Watch;

/// The rate of a link of which nobody says one.
const BAUD: u32 = 115_200;

pub(crate) fn run(args: &MonitorArgs, terminal: &Terminal) -> Result<Status> {
    let (device, file) = places(args);
    if let (Some("simulate"), Some(file)) = (device, file) {
        return subject::simulated(args, file, terminal, |subject, board, source| {
            Watch::new(args, terminal, subject, board, source).run()
        });
    }
    let subject = subject::read(args, file, terminal)?;
    let opened = match device {
        Some("simulate") => Err(Box::new(no_board::no_design(subject.at))),
        Some(path) if is_recording(path) => Source::recording(path)
            .map_err(|error| Box::new(no_board::unreadable(subject.at, path, &error.to_string()))),
        Some(path) => open(path, args, &subject),
        None => return found(args, terminal, &subject),
    };
    match opened {
        Ok(source) => {
            let Some(board) = subject.board(args, terminal)? else { return Ok(Status::Misused) };
            Watch::new(args, terminal, &subject, board, source).run()
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

/// Whether a path holds bytes of a board and is none: a file, a pipe, or the standard input.
fn is_recording(path: &str) -> bool {
    if path == "-" {
        return true;
    }
    let Ok(about) = std::fs::metadata(path) else { return false };
    let kind = about.file_type();
    if kind.is_file() {
        return true;
    }
    #[cfg(unix)]
    return std::os::unix::fs::FileTypeExt::is_fifo(&kind);
    #[cfg(not(unix))]
    false
}

fn open(path: &str, args: &MonitorArgs, subject: &Subject) -> Result<Source, Box<Diagnostic>> {
    let baud = args.baud.or(subject.boards.first().and_then(|board| board.baud)).unwrap_or(BAUD);
    let cure = |why: OpenError| {
        let ports: Vec<String> = usb_ports().into_iter().map(|(name, _)| name).collect();
        Box::new(no_board::not_opened(
            subject.at,
            &shown(Path::new(path)),
            &why.to_string(),
            &cure(&why, path, &ports),
        ))
    };
    Port::open(path, baud).map(Source::Port).map_err(cure)
}

/// What helps.
fn cure(why: &OpenError, path: &str, ports: &[String]) -> String {
    let instead = match ports {
        [] => "no USB port of this machine has a device: is the board plugged in, and is the cable one for data?".to_owned(),
        ports => format!("these are there: {}", ports.join(", ")),
    };
    match why {
        OpenError::Missing => instead,
        OpenError::Denied if cfg!(target_os = "linux") => format!(
            "the group that `ls -l {path}` names may open it: `sudo usermod -aG dialout $USER`, then log in again"
        ),
        OpenError::Denied => "run it as a user who may open the device".to_owned(),
        OpenError::Busy if cfg!(unix) => {
            format!("close that program; `fuser {path}` says which it is")
        }
        OpenError::Busy => "close that program".to_owned(),
        OpenError::NotSerial | OpenError::Other(_) => instead,
    }
}

/// Looks for the board on all USB ports: the first one that answers with the hash of a board of the design.
fn found(args: &MonitorArgs, terminal: &Terminal, subject: &Subject) -> Result<Status> {
    let mut tried = Vec::new();
    let wanted: Vec<&Board> = match &args.board {
        Some(_) => subject.board(args, terminal)?.into_iter().collect(),
        None => subject.boards.iter().collect(),
    };
    if wanted.is_empty() {
        return Ok(Status::Misused);
    }
    for (path, _) in usb_ports() {
        let port = match open(&path, args, subject) {
            Ok(Source::Port(port)) => port,
            Ok(_) => continue,
            Err(why) => {
                tried.push(format!("{path}: {}", why.message));
                continue;
            }
        };
        match watch::who(port, &wanted) {
            Ok((board, port)) => {
                terminal.aside(&format!("`{}` is at {path}", board.name))?;
                return Watch::new(args, terminal, subject, board, Source::Port(port)).run();
            }
            Err(why) => tried.push(format!("{path}: {why}")),
        }
    }
    terminal.diagnostics(&[no_board::none_found(subject.at, &tried)], &subject.sources)?;
    Err(Reported(Status::Misused).into())
}
