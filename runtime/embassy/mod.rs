//! Between the runtime, which knows no hardware, and Embassy's drivers. The same in every project.
#![allow(dead_code, reason = "a project uses what its devices need")]

// modules

use embassy_time::Instant;
use sense_rt::milliseconds;

/// Milliseconds since the start; wraps.
pub fn now_ms() -> u32 {
    milliseconds(Instant::now().as_micros())
}
