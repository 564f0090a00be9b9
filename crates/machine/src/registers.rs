//! Registers as all units have them.
//!
//! In: what a register holds, and a write to some of its bytes. Out: what it holds then. All units use this, also those
//! that the state of the chip is made of.

/// The value of a register after a write to the bits in `mask`.
pub(super) fn merge(old: u32, value: u32, mask: u32) -> u32 {
    (old & !mask) | (value & mask)
}
