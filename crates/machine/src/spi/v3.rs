//! The version with items of 4 to 16 bits and a FIFO of four bytes in each direction (F0, F3, F7, G0, G4, L4).
//!
//! An access of two bytes moves two items at once where an item is a byte or less. The surroundings take whole bytes:
//! an item of up to 8 bits is one, a longer one is two.

use std::collections::VecDeque;

use super::{BUSY, EMPTY, ENABLE, OVERRUN, RECEIVED, Unit, Version as _};
use crate::wires::Wires;

const FIFO_BYTES: usize = 4;
/// The bit of CR2 for an RXNE that a single byte sets, and not only two.
const BYTE_COUNTS: u32 = 1 << 12;

/// The FIFOs.
#[derive(Debug, Default)]
pub(super) struct Version {
    has_overrun: bool,
    received: VecDeque<u8>,
    waiting: VecDeque<u8>,
}

/// The bytes that an item takes in a FIFO.
fn item_bytes(unit: &Unit<Version>) -> usize {
    if Version::bits(unit) > 8 { 2 } else { 1 }
}

impl super::Version for Version {
    const CR2: u32 = 0x700;

    /// Codes for less than four bits stand for eight.
    fn bits(unit: &Unit<Self>) -> u64 {
        match unit.cr[1] >> 8 & 15 {
            0..=2 => 8,
            code => u64::from(code) + 1,
        }
    }

    /// The flags, with the fill levels of both FIFOs.
    fn sr(unit: &Unit<Self>) -> u32 {
        let Self { has_overrun, received, waiting } = &unit.version;
        let bit = |is_set: bool, bit: u32| if is_set { bit } else { 0 };
        let level = |fifo: &VecDeque<u8>| u32::try_from(fifo.len().min(3)).unwrap_or(3);
        let threshold = if unit.cr[1] & BYTE_COUNTS == 0 { 2 } else { 1 };
        let is_busy = unit.shifting.is_some() || !waiting.is_empty();
        bit(received.len() >= threshold, RECEIVED)
            | bit(waiting.len() <= FIFO_BYTES / 2, EMPTY)
            | bit(*has_overrun, OVERRUN)
            | bit(is_busy && unit.cr[0] & ENABLE != 0, BUSY)
            | level(received) << 9
            | level(waiting) << 11
    }

    fn next(unit: &mut Unit<Self>) -> Option<u16> {
        let bytes = item_bytes(unit);
        let waiting = &mut unit.version.waiting;
        (waiting.len() >= bytes).then(|| {
            let item = waiting.drain(..bytes).rev();
            item.fold(0, |item, byte| item << 8 | u16::from(byte))
        })
    }

    fn finish(unit: &mut Unit<Self>, item: u16, wires: &Wires) {
        let [high, low] = item.to_be_bytes();
        let exchange = |byte: u8, others: u64| unit.exchange(byte, others, wires);
        let answer = match item_bytes(unit) {
            2 => vec![exchange(high, 1), exchange(low, 0)],
            _ => vec![exchange(low, 0)],
        };
        let own = &mut unit.version;
        if own.received.len() + answer.len() > FIFO_BYTES {
            own.has_overrun = true;
        } else {
            // The low byte of an item is read first.
            own.received.extend(answer.into_iter().rev());
        }
    }

    fn clear_overrun(&mut self) {
        self.has_overrun = false;
    }

    fn take(unit: &mut Unit<Self>, bytes: u32) -> u32 {
        unit.has_read_data = unit.version.has_overrun;
        let bytes = bytes.min(2).max(u32::try_from(item_bytes(unit)).unwrap_or(2));
        (0..bytes).fold(0, |value, at| {
            value | u32::from(unit.version.received.pop_front().unwrap_or(0)) << (8 * at)
        })
    }

    /// Bytes for which the FIFO has no room are lost.
    fn put(unit: &mut Unit<Self>, value: u32, mask: u32) {
        let bytes = if mask >> 8 & 0xFF != 0 { 2 } else { 1 }.max(item_bytes(unit));
        for byte in value.to_le_bytes().into_iter().take(bytes) {
            if unit.version.waiting.len() < FIFO_BYTES {
                unit.version.waiting.push_back(byte);
            }
        }
    }
}
