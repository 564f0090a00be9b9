//! A board as its host sees it: what its link carries, whether it is the board that is meant, and its values as
//! people read and write them.
//!
//! In: the text of `schema.json`, the bytes of a link, a clock that only goes forward. Out: values, notes for people,
//! bytes to send. [`Session`] decides all that; it has no thread, no clock and no I/O. With the feature `serial`,
//! [`port`] opens serial ports, for one program alone, and finds a USB device again under another name.
//!
//! # Example
//!
//! ```
//! use std::time::Duration;
//! use sensedsl_host::{Board, Event, Session};
//!
//! let schema = r#"{ "version": 2, "boards": [ { "name": "Rover", "hash": "0x00b4763a", "checksum": "none",
//!     "items": [ { "id": 17, "name": "Light", "direction": "sensor", "type": "uint16", "scale": 0.1 } ] } ] }"#;
//! let boards = Board::all_of_json(schema).unwrap();
//! let mut session = Session::new(&boards[0], Duration::ZERO);
//!
//! // The board is asked who it is; its value counts once it has said so.
//! assert_eq!(session.to_send(Duration::ZERO), b"1:\0,");
//! let mut events = Vec::new();
//! session.feed(b"5:\0\x00\xb4\x76\x3a,3:\x11\x01\xf4,", Duration::ZERO, &mut |event| events.push(event));
//! let Event::Values(_, values) = &events[1] else { panic!("{events:?}") };
//! let (device, value) = &values[0];
//! assert_eq!(boards[0].devices[*device].text(value), "500 (50)");
//! ```

#[cfg(feature = "schema")]
mod clock;
mod difference;
#[cfg(feature = "schema")]
mod news;
#[cfg(feature = "serial")]
pub mod port;
mod scale;
#[cfg(feature = "schema")]
mod schema;
#[cfg(feature = "schema")]
mod session;
#[cfg(feature = "schema")]
mod stats;
#[cfg(feature = "schema")]
mod value;
#[cfg(feature = "schema")]
mod watch;
#[cfg(feature = "schema")]
mod words;

#[cfg(feature = "sources")]
#[path = "../sources.rs"]
pub mod sources;

#[cfg(feature = "schema")]
pub use clock::{BoardClock, ClockError};
pub use difference::{answered_schema, differences};
#[cfg(feature = "schema")]
pub use news::{Moment, News, Output, Report, What, Wish};
pub use scale::{Scale, halved};
#[cfg(feature = "schema")]
pub use schema::{Board, Device, SchemaError};
#[cfg(feature = "schema")]
pub use session::{Counts, Event, Session, State};
#[cfg(feature = "schema")]
pub use stats::{DeviceStats, Histogram};
#[cfg(feature = "schema")]
pub use value::{CommandError, Overstep};
#[cfg(feature = "schema")]
pub use watch::{Faults, keep_alive};
#[cfg(feature = "schema")]
pub use words::{causes, reset_cause, restarted, status};
