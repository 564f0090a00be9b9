//! Times on a clock that wraps.

/// Whole milliseconds make a cycle look shorter than it is, so a transfer may be made early by this
/// fraction of a cycle.
const EARLY_PARTS: u32 = 8;

/// Half the range of the clock is ahead, half is in the past, so the comparison holds across its
/// wrap.
pub(super) const fn is_reached(now_ms: u32, when_ms: u32) -> bool {
    now_ms.wrapping_sub(when_ms) < 0x8000_0000
}

pub(super) const fn left_ms(now_ms: u32, when_ms: u32) -> u32 {
    if is_reached(now_ms, when_ms) { 0 } else { when_ms.wrapping_sub(now_ms) }
}

/// The time after `wait_ms`, plus one, because the first millisecond is cut short.
pub(super) const fn after(now_ms: u32, wait_ms: u32) -> u32 {
    if wait_ms == 0 { now_ms } else { now_ms.wrapping_add(wait_ms).wrapping_add(1) }
}

/// How early a transfer of a chip with this cycle may be made.
pub(super) const fn early_ms(cycle_ms: u32) -> u32 {
    cycle_ms.div_ceil(EARLY_PARTS)
}
