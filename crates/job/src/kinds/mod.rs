//! What devices of a kind need under every system: which values share a CAN frame, which pulses wait for each other,
//! how the messages of a serial device are told apart.
//!
//! In: a [`crate::BoardJob`]. Out: decisions that depend on no system, for the plans of the targets.

pub mod can;
pub mod onewire;
pub mod pulse;
pub mod serial;
