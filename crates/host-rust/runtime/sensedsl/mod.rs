//! What all generated crates share; copied, not generated. Without the feature `std` it needs neither an operating
//! system nor memory to allocate.
//!
//! | module | knows |
//! | --- | --- |
//! | `values`, `message` | raw and shown values, limits; messages |
//! | `wire` | checksums, what a schema is, frames that are sent |
//! | `decode` | frames that are received, however the stream is cut |
//! | `health` | how a board and its devices are |
//! | `link` | whether the board is the one that is meant; no clock, no port |
//! | `board`, `outcome` (`std`) | a board on a serial port, which may go and come back; what comes of it |
//! | `stream` (`std`) | a board in a thread, for programs with an executor |

mod decode;
mod health;
mod link;
#[macro_use]
mod message;
mod values;
mod wire;

#[cfg(feature = "std")]
mod board;
#[cfg(feature = "std")]
mod outcome;
#[cfg(feature = "std")]
mod stream;

pub use decode::{Decoder, Found, Messages, Report};
pub use health::{DeviceHealth, Health, HealthFrame, ResetCause, Status};
pub use link::{Event, Link, State};
pub(crate) use message::print;
pub use message::{AnyMessage, Device};
pub use values::{Facts, Overstep, Raw, Refused, Scaling};
pub use wire::{
    Checksum, EncodeError, Item, Question, Schema, Stamp, Table, encode, encode_hello, encode_report, question,
};

#[cfg(feature = "std")]
pub use board::Board;
#[cfg(feature = "std")]
pub use outcome::{BoardHealth, Counts, Error, Received};
#[cfg(feature = "std")]
pub use stream::Stream;
