//! Where the bytes of a board come from: a serial port, a recording, a board in this program.

use std::fs::File;
use std::io::{self, Read};
use std::time::{Duration, Instant};

use sensedsl_host::port::{self, Identity, OpenError, Port};

use crate::commands::simulate::Simulated;

/// The interval at which a device that is gone is looked for.
const LOOK_EVERY: Duration = Duration::from_millis(50);

/// What came of reading.
pub(super) enum Input {
    /// Bytes, or nothing for a while.
    Bytes(Vec<u8>),
    /// A recording is over.
    Over,
    /// The device is gone.
    Gone,
}

/// One end of a link.
pub(super) enum Source {
    Port(Port),
    /// A device that is gone, and what is known of it.
    Away(Away),
    Recording(Box<dyn Read>),
    Simulated(Box<Simulated>),
}

/// A device that is waited for.
pub(super) struct Away {
    path: String,
    identity: Option<Identity>,
    baud: u32,
    pub(super) since: Instant,
}

impl Source {
    /// A recording: a file, or the standard input for `-`.
    pub(super) fn recording(path: &str) -> io::Result<Self> {
        let reader: Box<dyn Read> =
            if path == "-" { Box::new(io::stdin()) } else { Box::new(File::open(path)?) };
        Ok(Self::Recording(reader))
    }

    pub(super) fn is_recording(&self) -> bool {
        matches!(self, Self::Recording(_))
    }

    /// The bytes that come within a time.
    pub(super) fn read(&mut self, within: Duration) -> io::Result<Input> {
        Ok(match self {
            Self::Port(port) => port.read(within).map_or(Input::Gone, Input::Bytes),
            Self::Away(_) => {
                std::thread::sleep(within.min(LOOK_EVERY));
                Input::Bytes(Vec::new())
            }
            Self::Recording(reader) => {
                let mut bytes = vec![0; 1 << 16];
                match reader.read(&mut bytes)? {
                    0 => Input::Over,
                    count => {
                        bytes.truncate(count);
                        Input::Bytes(bytes)
                    }
                }
            }
            Self::Simulated(board) => {
                std::thread::sleep(within.min(Duration::from_millis(2)));
                Input::Bytes(board.read())
            }
        })
    }

    /// Sends bytes; false if the device is gone.
    pub(super) fn write(&mut self, bytes: &[u8]) -> bool {
        match self {
            Self::Port(port) => bytes.is_empty() || port.write(bytes).is_ok(),
            Self::Simulated(board) => {
                board.write(bytes);
                true
            }
            Self::Recording(_) | Self::Away(_) => true,
        }
    }

    /// Lets a device that is gone go, and says its path; none if it was no port.
    pub(super) fn lose(&mut self, baud: u32) -> Option<String> {
        let Self::Port(port) = self else { return None };
        let (path, identity) = (port.path().to_owned(), port.identity().cloned());
        *self = Self::Away(Away { path: path.clone(), identity, baud, since: Instant::now() });
        Some(path)
    }

    /// Opens a device that is back: by its USB identity where it has one, because another device may have got its name.
    pub(super) fn find_again(&mut self) -> Result<Option<(String, Duration)>, OpenError> {
        let Self::Away(away) = self else { return Ok(None) };
        let found = match &away.identity {
            Some(identity) => port::find(identity),
            None => Some(away.path.clone()),
        };
        let Some(path) = found else { return Ok(None) };
        let port = match Port::open(&path, away.baud) {
            Ok(port) => port,
            Err(OpenError::Missing) => return Ok(None),
            Err(why) => return Err(why),
        };
        let after = away.since.elapsed();
        *self = Self::Port(port);
        Ok(Some((path, after)))
    }
}
