//! The clock and the queues.

use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use embassy_sync::pipe::Pipe;
use embassy_time::Instant;
use sense_rt::milliseconds;

/// Milliseconds since the start; wraps.
#[must_use]
pub fn now_ms() -> u32 {
    milliseconds(Instant::now().as_micros())
}

/// Queues bytes; the caller has made sure that there is room for them. The queue is a ring, which
/// takes them only as far as its end at a time. False if some did not fit.
pub fn queue<const BYTES: usize>(
    ring: &Pipe<CriticalSectionRawMutex, BYTES>,
    bytes: &[u8],
) -> bool {
    let mut left = bytes;
    while !left.is_empty() {
        let Ok(size) = ring.try_write(left) else { return false };
        left = left.get(size..).unwrap_or_default();
    }
    true
}
