//! The parts of a chip's memory.

use super::ChipTable;
use crate::bytes::{copy, part_mut, split, word};
use crate::schema::Schema;

/// Bytes of the state of one transfer.
pub(super) const STATE_BYTES: usize = 8;

/// The sizes of the parts.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sizes {
    states: usize,
    calibration: usize,
    value: usize,
    kept: usize,
}

impl Sizes {
    pub(super) const fn new(table: &ChipTable, schema: &Schema) -> Self {
        Self {
            states: table.transfers.len() * STATE_BYTES,
            calibration: table.calibration_bytes(),
            value: table.value_bytes(schema),
            kept: table.kept.len(),
        }
    }
}

/// The parts after the states of the transfers.
pub(super) struct Memory<'a> {
    /// The calibration blocks.
    pub(super) calibration: &'a mut [u8],
    /// The place where a value is assembled.
    pub(super) value: &'a mut [u8],
    /// The last contents of the registers that commands share, as the bits that differ from their
    /// start values.
    pub(super) kept: &'a mut [u8],
    /// The bytes sent, then the bytes received.
    pub(super) work: &'a mut [u8],
}

impl<'a> Memory<'a> {
    #[inline(never)]
    pub(super) fn split(memory: &'a mut [u8], sizes: &Sizes) -> Self {
        let (_, rest) = split(memory, sizes.states);
        let (calibration, rest) = split(rest, sizes.calibration);
        let (value, rest) = split(rest, sizes.value);
        let (kept, work) = split(rest, sizes.kept);
        Self { calibration, value, kept, work }
    }
}

/// When a transfer is due: for its trigger, or without one for reading.
#[inline(never)]
pub(super) fn due_ms(memory: &[u8], transfer: usize) -> u32 {
    word(memory, transfer.wrapping_mul(STATE_BYTES))
}

/// When a transfer can be read.
#[inline(never)]
pub(super) fn ready_ms(memory: &[u8], transfer: usize) -> u32 {
    word(memory, transfer.wrapping_mul(STATE_BYTES).wrapping_add(4))
}

#[inline(never)]
pub(super) fn set_due_ms(memory: &mut [u8], transfer: usize, due_ms: u32) {
    let place = transfer.wrapping_mul(STATE_BYTES);
    copy(part_mut(memory, place, 4), &due_ms.to_be_bytes());
}

#[inline(never)]
pub(super) fn set_ready_ms(memory: &mut [u8], transfer: usize, ready_ms: u32) {
    let place = transfer.wrapping_mul(STATE_BYTES).wrapping_add(4);
    copy(part_mut(memory, place, 4), &ready_ms.to_be_bytes());
}
