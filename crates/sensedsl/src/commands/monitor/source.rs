//! Where the bytes of a board come from: a serial port, a recording, a board in this program.
//!
//! Ports and recordings are read by threads, which say when each byte came; a board in this program is asked.

use std::fs::File;
use std::io::{self, Read};
use std::sync::mpsc::SyncSender;
use std::time::{Duration, Instant};

use sensedsl_host::Moment;
use sensedsl_host::port::{self, Identity, OpenError, Port};
use sensedsl_record::{Ending, Past};

use crate::commands::simulate::Simulated;

/// The rate of a link of which nobody says one, in bits a second.
pub(super) const BAUD: u32 = 115_200;

/// How often a device that is gone is looked for.
const LOOK_EVERY: Duration = Duration::from_millis(50);
/// How long a thread waits for bytes before it sees whether it is still wanted.
const WAIT: Duration = Duration::from_millis(100);

/// What threads tell the loop.
pub(super) enum Heard {
    /// Something of a board's link.
    Of {
        /// The place of the link.
        link: usize,
        /// Which opening of it: what an earlier one has left is not of this one.
        opening: u32,
        /// What came.
        what: Input,
    },
    /// Something of a record.
    Past {
        /// The place of the link.
        link: usize,
        /// When it was.
        at: Moment,
        /// What it was.
        what: Past,
    },
    /// The record is over; if it cannot be read to its end, why.
    PastOver(Result<Ending, String>),
    /// A line that somebody typed.
    Line(String),
}

/// What came of reading.
pub(super) enum Input {
    /// Bytes, and when they came.
    Bytes(Instant, Vec<u8>),
    /// A recording is over, or cannot be read any more.
    Over(Option<io::Error>),
    /// The device is gone.
    Gone,
}

/// One end of a link.
pub(super) enum Source {
    Port(Port),
    /// A device that is gone, and what is known of it.
    Away(Away),
    /// A part of a record, which is replayed for all its boards at once.
    Replayed,
    Recording(Option<Box<dyn Read + Send>>),
    Simulated(Box<Simulated>),
}

/// A device that is waited for.
pub(super) struct Away {
    path: String,
    identity: Option<Identity>,
    baud: u32,
    pub(super) since: Instant,
    looked: Instant,
}

impl Source {
    /// A recording: a file, or the standard input for `-`.
    pub(super) fn recording(path: &str) -> io::Result<Self> {
        let reader: Box<dyn Read + Send> =
            if path == "-" { Box::new(io::stdin()) } else { Box::new(File::open(path)?) };
        Ok(Self::Recording(Some(reader)))
    }

    /// The path of the port, also of one that is gone.
    pub(super) fn path(&self) -> Option<&str> {
        match self {
            Self::Port(port) => Some(port.path()),
            Self::Away(away) => Some(&away.path),
            Self::Recording(_) | Self::Simulated(_) | Self::Replayed => None,
        }
    }

    pub(super) fn is_recording(&self) -> bool {
        matches!(self, Self::Recording(_) | Self::Replayed)
    }

    /// Begins to read, for the given link and opening.
    pub(super) fn listen(
        &mut self,
        link: usize,
        opening: u32,
        to: &SyncSender<Heard>,
    ) -> io::Result<()> {
        let to = to.clone();
        let tell = move |what| to.send(Heard::Of { link, opening, what }).is_ok();
        match self {
            Self::Port(port) => {
                let port = port.try_clone()?;
                let _ = std::thread::spawn(move || hear_port(port, &tell));
            }
            Self::Recording(reader) => {
                if let Some(reader) = reader.take() {
                    let _ = std::thread::spawn(move || hear_recording(reader, &tell));
                }
            }
            Self::Away(_) | Self::Simulated(_) | Self::Replayed => {}
        }
        Ok(())
    }

    /// Sends bytes; false if the device is gone.
    pub(super) fn write(&mut self, bytes: &[u8]) -> bool {
        match self {
            Self::Port(port) => bytes.is_empty() || port.write(bytes).is_ok(),
            Self::Simulated(board) => {
                board.write(bytes);
                true
            }
            Self::Recording(_) | Self::Away(_) | Self::Replayed => true,
        }
    }

    /// Lets a device that is gone go, and says its path; none if it was no port.
    pub(super) fn lose(&mut self, baud: u32) -> Option<String> {
        let Self::Port(port) = self else { return None };
        let (path, identity) = (port.path().to_owned(), port.identity().cloned());
        let now = Instant::now();
        *self = Self::Away(Away { path: path.clone(), identity, baud, since: now, looked: now });
        Some(path)
    }

    /// Opens a device that is back: by its USB identity where it has one, because another device may have got its name.
    pub(super) fn find_again(&mut self) -> Result<Option<(String, Duration)>, OpenError> {
        let Self::Away(away) = self else { return Ok(None) };
        if away.looked.elapsed() < LOOK_EVERY {
            return Ok(None);
        }
        away.looked = Instant::now();
        let found = match &away.identity {
            Some(identity) => port::find(identity),
            None => Some(away.path.clone()),
        };
        let Some(path) = found else { return Ok(None) };
        let port = match Port::open(&path, away.baud) {
            Ok(port) => port,
            Err(OpenError::Missing | OpenError::Unreachable(_)) => return Ok(None),
            Err(why) => return Err(why),
        };
        let after = away.since.elapsed();
        *self = Self::Port(port);
        Ok(Some((path, after)))
    }
}

fn hear_port(mut port: Port, tell: &dyn Fn(Input) -> bool) {
    loop {
        let Ok(bytes) = port.read(WAIT) else {
            let _ = tell(Input::Gone);
            return;
        };
        // Nothing is told as well: only so the thread learns that nobody listens any more.
        if !tell(Input::Bytes(Instant::now(), bytes)) {
            return;
        }
    }
}

fn hear_recording(mut reader: Box<dyn Read + Send>, tell: &dyn Fn(Input) -> bool) {
    loop {
        let mut bytes = vec![0; 1 << 14];
        let what = match reader.read(&mut bytes) {
            Ok(0) => Input::Over(None),
            Ok(count) => {
                bytes.truncate(count);
                Input::Bytes(Instant::now(), bytes)
            }
            Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
            Err(error) => Input::Over(Some(error)),
        };
        let is_over = matches!(what, Input::Over(_));
        if !tell(what) || is_over {
            return;
        }
    }
}
