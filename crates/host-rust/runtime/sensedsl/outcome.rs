//! What comes of a board: messages, its health, counts, errors.

use std::fmt;
use std::time::Instant;

use sensedsl_host::port::OpenError;

use super::health::{DeviceHealth, Health};
use super::values::Refused;
use super::wire::{EncodeError, Stamp};

/// A message that has come.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Received<M> {
    /// The message.
    pub message: M,
    /// When it came.
    pub at: Instant,
    /// When the board put its report together, where the link has stamps.
    pub stamp: Option<Stamp>,
}

/// How a board and its devices are.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BoardHealth {
    /// How the board is.
    pub board: Health,
    /// How its devices are, in the design's order.
    pub devices: Vec<DeviceHealth>,
}

/// What was counted since a board was opened.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Whole frames.
    pub frames: u64,
    /// Bytes that belong to no frame.
    pub dropped_bytes: u64,
    /// Reports that the counters of stamps say were lost.
    pub lost_reports: u64,
}

/// Why a board cannot be used.
#[derive(Clone, Debug, PartialEq)]
pub enum Error {
    /// Its port is not opened.
    Open(String, OpenError),
    /// No USB port has such a board: what was tried, and why it is not the board.
    NotFound(Vec<String>),
    /// It has the firmware of another design: its hash and, if it tells them, the differences.
    OtherFirmware(u32, Vec<String>),
    /// It is gone, and is not waited for.
    Gone(String),
    /// It does not answer.
    Silent(&'static str),
    /// A command is beyond a limit of the design.
    Refused(Refused),
    /// Commands do not make a frame.
    Encode(EncodeError),
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Open(path, why) => write!(f, "{path} cannot be opened: {why}"),
            Self::NotFound(tried) => {
                f.write_str("no USB port has a board of this design")?;
                tried.iter().try_for_each(|line| write!(f, "\n  {line}"))
            }
            Self::OtherFirmware(hash, differences) => {
                write!(f, "the board runs other firmware than this program was generated for (schema 0x{hash:08x})")?;
                differences.iter().try_for_each(|line| write!(f, "\n  {line}"))
            }
            Self::Gone(why) => write!(f, "the board is gone: {why}"),
            Self::Silent(name) => write!(f, "{name} does not answer"),
            Self::Refused(refused) => refused.fmt(f),
            Self::Encode(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for Error {}

impl From<Refused> for Error {
    fn from(refused: Refused) -> Self {
        Self::Refused(refused)
    }
}

impl From<EncodeError> for Error {
    fn from(error: EncodeError) -> Self {
        Self::Encode(error)
    }
}
