//! SPI1 to SPI6 as masters.

use super::mcu::Mcu;
use super::ports::{PortState, Setting};
use super::wires::{NEVER, Wires, merge, periods_ns};

/// Bits of SR.
const RECEIVED: u32 = 1;
const EMPTY: u32 = 1 << 1;
const OVERRUN: u32 = 1 << 6;
const BUSY: u32 = 1 << 7;
/// Bits of CR1.
const MASTER: u32 = 1 << 2;
const ENABLE: u32 = 1 << 6;
const WIDE: u32 = 1 << 11;

/// An SPI port.
#[derive(Debug)]
pub(super) struct Spi {
    unit: u8,
    mcu: &'static Mcu,
    irq: u16,
    is_on_apb2: bool,
    cr: [u32; 2],
    other: [u32; 5],
    sr: u32,
    received: u16,
    waiting: Option<u16>,
    shifting: Option<u16>,
    until: u64,
    has_read_data: bool,
    wires: [String; 3],
}

impl Spi {
    pub(super) fn new(unit: u8, mcu: &'static Mcu) -> Self {
        let own = format!("SPI{unit}");
        Self {
            unit,
            mcu,
            irq: mcu.irq(&own, "GLOBAL"),
            is_on_apb2: mcu.is_on_apb2(&own),
            cr: [0; 2],
            other: [7, 0, 0, 0, 2],
            sr: EMPTY,
            received: 0,
            waiting: None,
            shifting: None,
            until: NEVER,
            has_read_data: false,
            wires: ["SCK", "MISO", "MOSI"].map(|wire| format!("SPI{unit}_{wire}")),
        }
    }

    /// Restarts it in its state after a reset.
    pub(super) fn restart(&mut self, wires: &mut Wires) {
        *self = Self::new(self.unit, self.mcu);
        self.tell(wires);
    }

    fn clock_hz(&self, wires: &Wires) -> u64 {
        if self.is_on_apb2 { wires.clocks.apb2 } else { wires.clocks.apb1 }
    }

    /// Its settings, once it is a master.
    pub(super) fn state(&self, wires: &Wires) -> Option<PortState> {
        let [cr, _] = self.cr;
        let fastest_hz = self.clock_hz(wires) / 2;
        let clock_hz = fastest_hz >> (cr >> 3 & 7);
        let setting = Setting::Spi { clock_hz, fastest_hz, mode: (cr & 3) as u8 };
        (cr & MASTER != 0).then(|| PortState { unit: format!("SPI{}", self.unit), setting })
    }

    pub(super) fn deadline(&self) -> u64 {
        self.until
    }

    fn begin(&mut self, at: u64, wires: &Wires) {
        self.until = NEVER;
        if self.cr[0] & (ENABLE | MASTER) != ENABLE | MASTER || self.shifting.is_some() {
            return;
        }
        let Some(item) = self.waiting.take() else {
            self.sr &= !BUSY;
            return;
        };
        let clock = self.clock_hz(wires);
        let bits = if self.cr[0] & WIDE != 0 { 16 } else { 8 };
        self.shifting = Some(item);
        self.sr |= EMPTY | BUSY;
        self.until = at + periods_ns(bits << ((self.cr[0] >> 3 & 7) + 1), clock);
    }

    pub(super) fn advance(&mut self, wires: &mut Wires) {
        while self.until <= wires.now {
            let at = self.until;
            let Some(item) = self.shifting.take() else { break };
            self.finish(item, wires);
            self.begin(at, wires);
        }
        self.tell(wires);
    }

    fn finish(&mut self, item: u16, wires: &Wires) {
        let [clock, input, output] = self.wires.each_ref().map(|wire| wires.pad_of(wire).is_some());
        let exchange = |byte: u8| {
            if !clock {
                return 0xFF;
            }
            // A wire that is not on any pad sends and receives nothing useful.
            let sent = if output { byte } else { 0xFF };
            let answer = wires.world(|world, now| world.spi(self.unit, sent, now));
            if input { answer } else { 0xFF }
        };
        let [high, low] = item.to_be_bytes();
        let answer = if self.cr[0] & WIDE != 0 {
            u16::from_be_bytes([exchange(high), exchange(low)])
        } else {
            u16::from(exchange(low))
        };
        if self.sr & RECEIVED != 0 {
            self.sr |= OVERRUN;
        } else {
            self.received = answer;
            self.sr |= RECEIVED;
        }
    }

    fn tell(&self, wires: &mut Wires) {
        let cr = self.cr[1];
        let held = (cr >> 7 & 1 == 1 && self.sr & EMPTY != 0)
            || (cr >> 6 & 1 == 1 && self.sr & RECEIVED != 0)
            || (cr >> 5 & 1 == 1 && self.sr & OVERRUN != 0);
        wires.interrupt(self.irq, 0, held);
    }

    pub(super) fn asks(&self, transmits: bool) -> bool {
        if transmits {
            self.cr[1] & 2 != 0 && self.sr & EMPTY != 0 && self.cr[0] & ENABLE != 0
        } else {
            self.cr[1] & 1 != 0 && self.sr & RECEIVED != 0
        }
    }

    pub(super) fn read(&mut self, offset: u32, wires: &mut Wires) -> u32 {
        let value = match offset {
            0x00 | 0x04 => self.cr[(offset / 4) as usize],
            0x08 => {
                let value = self.sr;
                if self.has_read_data {
                    self.sr &= !OVERRUN;
                    self.has_read_data = false;
                }
                value
            }
            0x0C => {
                self.sr &= !RECEIVED;
                self.has_read_data = self.sr & OVERRUN != 0;
                u32::from(self.received)
            }
            0x10..=0x20 => self.other[((offset - 0x10) / 4) as usize],
            _ => 0,
        };
        self.tell(wires);
        value
    }

    pub(super) fn write(&mut self, offset: u32, value: u32, mask: u32, wires: &mut Wires) {
        match offset {
            0x00 | 0x04 => {
                let register = &mut self.cr[(offset / 4) as usize];
                *register = merge(*register, value, mask);
            }
            0x0C => {
                self.waiting = Some((value & mask & 0xFFFF) as u16);
                self.sr &= !EMPTY;
            }
            0x10..=0x20 => {
                let register = &mut self.other[((offset - 0x10) / 4) as usize];
                *register = merge(*register, value, mask);
            }
            _ => {}
        }
        if self.until == NEVER {
            self.begin(wires.now, wires);
        }
        self.tell(wires);
    }
}
