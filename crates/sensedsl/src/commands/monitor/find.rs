//! Which board is where: ports are opened, and asked who they are.

use std::path::Path;
use std::time::{Duration, Instant};

use anyhow::Result;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_diagnostics::codes::e0557_no_board as no_board;
use sensedsl_host::Board;
use sensedsl_host::port::{OpenError, Port, usb_ports};
use sensedsl_wire::{Decoder, Direction, Event as Received, encode_hello_request};

use super::source::{BAUD, Source};
use super::subject::Subject;
use crate::cli::MonitorArgs;
use crate::files::shown;
use crate::status::{Reported, Status};
use crate::terminal::Terminal;

/// How long a board may take to say who it is.
const ANSWERS_WITHIN: Duration = Duration::from_millis(1_500);
/// How long one read waits.
const WAIT: Duration = Duration::from_millis(20);

/// Whether a path holds bytes of a board and is none: a file, a pipe, or the standard input.
pub(super) fn is_recording(path: &str) -> bool {
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

/// Opens the port of a board, or of one of several.
pub(super) fn open(
    path: &str,
    baud: Option<u32>,
    subject: &Subject,
) -> Result<Port, Box<Diagnostic>> {
    let cure = |why: OpenError| {
        let ports: Vec<String> = usb_ports().into_iter().map(|(name, _)| name).collect();
        Box::new(no_board::not_opened(
            subject.at,
            &shown(Path::new(path)),
            &why.to_string(),
            &cure(&why, path, &ports),
        ))
    };
    Port::open(path, baud.unwrap_or(BAUD)).map_err(cure)
}

/// What helps.
pub(crate) fn cure(why: &OpenError, path: &str, ports: &[String]) -> String {
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
        OpenError::Unreachable(_) => {
            "`sensedsl simulate FILE --tcp PORT` says where it is; write tcp:HOST:PORT".to_owned()
        }
        OpenError::NotSerial | OpenError::Other(_) => instead,
    }
}

/// Looks for boards on all USB ports, and gives those that answered with the hash of one of them.
pub(super) fn found<'s>(
    args: &MonitorArgs,
    terminal: &Terminal,
    subject: &'s Subject,
    mut wanted: Vec<&'s Board>,
) -> Result<Vec<(&'s Board, Source)>> {
    let (mut tried, mut all) = (Vec::new(), Vec::new());
    for (path, _) in usb_ports() {
        if wanted.is_empty() {
            break;
        }
        let baud = args.baud.or(wanted.iter().find_map(|board| board.baud));
        let port = match open(&path, baud, subject) {
            Ok(port) => port,
            Err(why) => {
                tried.push(format!("{path}: {}", why.message));
                continue;
            }
        };
        match who(port, &wanted) {
            Ok((board, port)) => {
                terminal.aside(&format!("`{}` is at {path}", board.name))?;
                wanted.retain(|one| one.name != board.name);
                all.push((board, Source::Port(port)));
            }
            Err(why) => tried.push(format!("{path}: {why}")),
        }
    }
    if all.is_empty() {
        terminal.diagnostics(&[no_board::none_found(subject.at, &tried)], &subject.sources)?;
        return Err(Reported(Status::Misused).into());
    }
    for board in wanted {
        terminal.aside(&format!(
            "`{}` is on no USB port; `--at {}=DEVICE` says where it is",
            board.name, board.name
        ))?;
    }
    Ok(all)
}

/// Which of some boards is behind a port; otherwise why none is.
pub(super) fn who<'b>(mut port: Port, boards: &[&'b Board]) -> Result<(&'b Board, Port), String> {
    let began = Instant::now();
    let mut decoders: Vec<(&Board, Decoder<'_>)> = boards
        .iter()
        .map(|board| (*board, Decoder::new(&board.schema, Direction::Sensor)))
        .collect();
    let mut asked: Option<Instant> = None;
    let (mut bytes_seen, mut other) = (0, None);
    while began.elapsed() < ANSWERS_WITHIN {
        if asked.is_none_or(|asked| asked.elapsed() >= Duration::from_millis(250)) {
            asked = Some(Instant::now());
            for board in boards {
                port.write(&encode_hello_request(&board.schema))
                    .map_err(|error| error.to_string())?;
            }
        }
        let bytes = port.read(WAIT).map_err(|error| error.to_string())?;
        bytes_seen += bytes.len();
        for (board, decoder) in &mut decoders {
            let mut hash = None;
            decoder.feed(&bytes, |event| {
                if let Received::Hello(said) = event {
                    hash = Some(said);
                }
            });
            match hash {
                Some(hash) if hash == board.schema.hash() => return Ok((board, port)),
                Some(hash) => other = Some(hash),
                None => {}
            }
        }
    }
    Err(match other {
        Some(hash) => format!("it runs the firmware of another design (0x{hash:08x})"),
        None if bytes_seen == 0 => "nothing comes from it".to_owned(),
        None => "what comes from it are no frames of this design".to_owned(),
    })
}
