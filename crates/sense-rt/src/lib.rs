//! The runtime of Rust firmware: everything between the hardware of a board and its link that does
//! not depend on the hardware.
//!
//! In: what was read from pins, buses and ports, and the time as a number. Out: values, frames,
//! transfers to make. Nothing here waits, allocates, locks or panics, and nothing is unsafe; the
//! code that owns the HAL, blocking or async, carries out what these state machines ask for.
//!
//! **Tables are constants.** A generator prints them: [`Schema`], [`ChipTable`], [`MessageTable`] …
//! Each has a `NEW` in which every member has its usual value, so that only the differences are
//! printed.
//!
//! **A value is its bytes on the wire**: its elements one after the other in network byte order, as
//! [`Scalar`] reads and writes them. A report is therefore assembled by copying, and the same code
//! serves all types.
//!
//! **State has its memory inside**, sized by a constant function of its table, and can be a
//! `static`: `Store<[u8; SCHEMA.values_bytes()]>`. Each such type dereferences to its unsized form
//! (`Store<[u8]>`), which has the methods: one copy of the code serves all sizes.
//!
//! `crates/firmware-c/runtime` is the same runtime in C; tests hold both to the same vectors and to
//! each other.
//!
//! # Example
//!
//! ```
//! use sense_rt::{Checksum, Decoder, Direction, Frame, Item, Scalar, Schema};
//!
//! const SCHEMA: Schema = Schema {
//!     items: &[Item::actuator(33, Scalar::Int16, 1)],
//!     hash: 7,
//!     stamp: false,
//!     checksum: Checksum::None,
//! };
//! let mut decoder: Decoder<[u8; SCHEMA.frame_bytes(Direction::ToBoard)]> =
//!     Decoder::new(&SCHEMA, Direction::ToBoard);
//! let mut speed = None;
//! decoder.feed(b"noise 3:\x21\x01\x02,", &mut |frame| {
//!     if let Frame::Values(_, mut items) = frame {
//!         speed = items.next().map(|(index, value)| (index, value.to_vec()));
//!     }
//! });
//! assert_eq!(speed, Some((0, vec![1, 2])));
//! ```
#![no_std]
#![forbid(unsafe_code)]

mod bits;
mod bytes;
mod capture;
mod checksum;
mod chip;
mod coding;
mod compose;
mod contact;
mod convert;
mod count;
mod decode;
mod drive;
mod elements;
mod encode;
mod exchange;
mod filter;
mod formula;
mod health;
mod lamps;
mod letters;
mod listener;
mod message;
pub mod onewire;
mod outcome;
mod parse;
mod pulse_width;
mod reporter;
mod requests;
mod scalar;
mod schema;
mod silence;
mod stepper;
mod store;
mod train;
mod uses;
mod watch;

#[cfg(feature = "sources")]
#[path = "../sources.rs"]
pub mod sources;

pub use bits::Bits;
pub use capture::{Capture, CaptureConfig, CaptureMode, Captured};
pub use checksum::{Checksum, crc8, crc16, crc16_of, crc32, sum8, sum16, xor8};
pub use chip::{
    Calibration, Chip, ChipCounts, ChipTable, Command, Identity, InitStep, Reading, Step, Transfer,
};
pub use coding::{Code, Coding, Crc};
pub use compose::Compose;
pub use contact::{Contact, ContactConfig, ContactReport, Edge};
pub use convert::{
    load_magnitude, milliseconds, store_mean, store_ratio, store_signed, store_signed_ratio,
    store_unsigned,
};
pub use count::{Counter, Repeat, Turn, store_count};
pub use decode::{Decoder, Frame, Items};
pub use drive::{Bridge, BridgeMode, BridgeState, Write, Writes};
pub use elements::Elements;
pub use encode::{
    Stamp, encode_health, encode_health_request, encode_hello, encode_hello_request, encode_values,
};
pub use exchange::{Echo, Exchange, Heard, Reply};
pub use filter::{Filter, FilterTable, Number, Range, WIDE, Wide, decay};
pub use formula::{BME280, BMP280, Formula, HX711, NTC, OUTPUTS_MAX, Outputs, TSL2561};
pub use health::{
    AGE_LONG, AGE_NEVER, BoardHealth, Cause, Fault, Health, HealthRow, LOAD_UNKNOWN, Record,
    STACK_UNKNOWN, Status,
};
pub use message::{
    FieldFormat, MessageChecksum, MessageField, MessageStart, MessageStream, MessageTable,
    StreamCounts,
};
pub use outcome::{Outcome, Sink};
pub use parse::{field, parse_decimal, parse_degrees, parse_hex};
pub use pulse_width::{LEVEL_FULL, PulseWidth, pulse_counts, pulse_level};
pub use reporter::{Channel, Host, Reporter, ReporterConfig, ReporterCounts};
pub use requests::Requests;
pub use scalar::Scalar;
pub use schema::{Direction, FRAME_BYTES_LIMIT, ITEMS_MAX, Item, Schema};
pub use silence::Silence;
pub use stepper::{MotorConfig, Stepper, TICK_HZ_MAX};
pub use store::Store;
pub use train::{CHANNELS_MAX, Train, TrainConfig};
pub use watch::Watch;
