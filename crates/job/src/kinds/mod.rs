//! What devices of a kind come to under every system: which values share a frame of CAN, which pulses wait for each
//! other, how messages of a serial device are told apart.
//!
//! In: a [`crate::BoardJob`]. Out: decisions in words that name no system, for the plans of the targets.

pub mod can;
pub mod pulse;
pub mod serial;
