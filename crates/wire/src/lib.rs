//! The wire between the board and its host: scalar types, schema, Netstring codec.
//!
//! Only this crate defines how values become bytes. Every other codec of the project (C, C++, …)
//! must pass the vectors in `tests/vectors`, which hold it to this one. Needs no operating system.
//!
//! # Example
//!
//! ```
//! use sensedsl_wire::{
//!     Decoder, Direction, Event, Item, Scalar, ScalarType, Schema, ValueType, encode_report,
//! };
//!
//! let light = Item {
//!     id: 17,
//!     name: "Light".to_owned(),
//!     direction: Direction::Sensor,
//!     value: ValueType::scalar(ScalarType::Uint16),
//! };
//! let schema = Schema { items: vec![light], ..Schema::default() };
//! let values = [(17, vec![Scalar::Unsigned(500)])];
//! let frame = encode_report(&schema, Direction::Sensor, &values).unwrap();
//! assert_eq!(frame, b"3:\x11\x01\xf4,");
//!
//! let mut events = Vec::new();
//! Decoder::new(&schema, Direction::Sensor).feed(&frame, |event| events.push(event));
//! assert_eq!(events, [Event::Report(None, values.to_vec())]);
//! ```
#![no_std]

extern crate alloc;

mod checksum;
mod decode;
mod encode;
mod frame;
mod health;
mod scalar;
mod schema;

#[cfg(feature = "sources")]
#[path = "../sources.rs"]
pub mod sources;

pub use checksum::{crc16_ccitt_false, crc32_iso_hdlc};
pub use decode::Decoder;
pub use encode::{
    EncodeError, encode_health, encode_health_request, encode_hello, encode_hello_request,
    encode_report, encode_stamped_report,
};
pub use frame::{Event, Frame, Report, Stamp, Value, Values};
pub use health::{
    Causes, DeviceHealth, HEALTH_VERSION, Health, HealthFrame, NEVER_MS, ResetCause, Status,
    UNKNOWN_LOAD, UNKNOWN_STACK,
};
pub use scalar::{Scalar, ScalarType, ValueType};
pub use schema::{
    Checksum, Direction, ID_CHECKSUM, ID_HEALTH, ID_HELLO, Item, STAMP_BYTES, Schema,
};
