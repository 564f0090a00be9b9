//! The first two versions of the block (F1, F2, F4, L1): room for one item in each direction, of 8 or 16 bits.

use super::{BUSY, EMPTY, OVERRUN, RECEIVED, Unit};
use crate::wires::Wires;

/// The bit of CR1 for items of 16 bits.
const WIDE: u32 = 1 << 11;

/// The flags, and the items.
#[derive(Debug)]
pub(super) struct Version {
    sr: u32,
    received: u16,
    waiting: Option<u16>,
}

impl Default for Version {
    fn default() -> Self {
        Self { sr: EMPTY, received: 0, waiting: None }
    }
}

impl super::Version for Version {
    const CR2: u32 = 0;

    fn bits(unit: &Unit<Self>) -> u64 {
        if unit.cr[0] & WIDE != 0 { 16 } else { 8 }
    }

    fn sr(unit: &Unit<Self>) -> u32 {
        unit.version.sr
    }

    fn next(unit: &mut Unit<Self>) -> Option<u16> {
        let own = &mut unit.version;
        let item = own.waiting.take();
        own.sr = if item.is_some() { own.sr | EMPTY | BUSY } else { own.sr & !BUSY };
        item
    }

    fn finish(unit: &mut Unit<Self>, item: u16, wires: &Wires) {
        let [high, low] = item.to_be_bytes();
        let exchange = |byte: u8, others: u64| unit.exchange(byte, others, wires);
        let answer = if unit.cr[0] & WIDE != 0 {
            u16::from_be_bytes([exchange(high, 1), exchange(low, 0)])
        } else {
            u16::from(exchange(low, 0))
        };
        let own = &mut unit.version;
        if own.sr & RECEIVED != 0 {
            own.sr |= OVERRUN;
        } else {
            own.received = answer;
            own.sr |= RECEIVED;
        }
    }

    fn clear_overrun(&mut self) {
        self.sr &= !OVERRUN;
    }

    fn take(unit: &mut Unit<Self>, _: u32) -> u32 {
        unit.version.sr &= !RECEIVED;
        unit.has_read_data = unit.version.sr & OVERRUN != 0;
        u32::from(unit.version.received)
    }

    fn put(unit: &mut Unit<Self>, value: u32, mask: u32) {
        unit.version.waiting = Some((value & mask & 0xFFFF) as u16);
        unit.version.sr &= !EMPTY;
    }
}
