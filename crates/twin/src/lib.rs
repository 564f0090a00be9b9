//! A board's twin: firmware runs on an emulated MCU, and a simulated world is on its pins.
//!
//! In: bytes, which are an image and what a host sends. Out: events with times. Time is virtual and counted in
//! nanoseconds since the board got power, so that a run is the same each time, to the byte.
//!
//! [`Surroundings`](sensedsl_surroundings::Surroundings) is the interface: an emulated MCU (feature `machine`) asks for
//! the signals on its pads and buses, and the parts here answer.
//!
//! [`world`] describes what happens around a board, [`mod@bench`] puts parts behind its pins, [`soft`] does the board's
//! job in this program, `emulated` does it with an image on the machine, and [`judge`] compares the board's reports
//! with the world. Nothing in this crate reads a file or a clock.

mod arith;
pub mod bench;
pub mod commands;
#[cfg(feature = "machine")]
pub mod emulated;
pub mod judge;
#[cfg(feature = "machine")]
pub mod pads;
mod parts;
#[cfg(feature = "machine")]
mod ports;
pub mod range;
pub mod soft;
pub mod truth;
pub mod world;
