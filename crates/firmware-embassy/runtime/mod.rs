//! Between the runtime, which knows no hardware, and Embassy's drivers. The same in every project.
#![allow(dead_code, reason = "a project uses what its devices need")]

// modules

use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use embassy_sync::pipe::Pipe;
use embassy_time::Instant;
use sense_rt::milliseconds;

/// Milliseconds since the start; wraps.
pub fn now_ms() -> u32 {
    milliseconds(Instant::now().as_micros())
}

/// Queues bytes that there is room for. The queue is a ring: it takes them only as far as its end at a time.
pub fn queue<const BYTES: usize>(ring: &Pipe<CriticalSectionRawMutex, BYTES>, bytes: &[u8]) -> bool {
    let mut left = bytes;
    while !left.is_empty() {
        let Ok(size) = ring.try_write(left) else { return false };
        left = left.get(size..).unwrap_or_default();
    }
    true
}
