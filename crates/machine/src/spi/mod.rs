//! SPI ports as masters, with a file for each version of the block.
//!
//! In: accesses of the program, and the answers of the chips on the bus. Out: bytes, at the bus's speed, interrupts,
//! requests to the DMA.

mod v1;
mod v3;

use crate::mcu::Mcu;
use crate::ports::{PortState, Setting};
use crate::registers::merge;
use crate::wires::{NEVER, Wires, periods_ns};

/// Bits of SR.
const RECEIVED: u32 = 1;
const EMPTY: u32 = 1 << 1;
const OVERRUN: u32 = 1 << 6;
const BUSY: u32 = 1 << 7;
/// Bits of CR1.
const MASTER: u32 = 1 << 2;
const ENABLE: u32 = 1 << 6;
/// Bits of CR2.
const RECEIVES_BY_DMA: u32 = 1;
const TRANSMITS_BY_DMA: u32 = 1 << 1;
const ERROR_INTERRUPTS: u32 = 1 << 5;
const RECEIVED_INTERRUPTS: u32 = 1 << 6;
const EMPTY_INTERRUPTS: u32 = 1 << 7;

/// A port, in any of the block's versions.
pub(crate) trait Spi: Send {
    /// Restarts it in its state after a reset.
    fn restart(&mut self, wires: &mut Wires);
    /// Its settings, once it is a master.
    fn state(&self, wires: &Wires) -> Option<PortState>;
    fn deadline(&self) -> u64;
    fn advance(&mut self, wires: &mut Wires);
    /// Whether it requests a transfer by the DMA.
    fn asks(&self, transmits: bool) -> bool;
    /// Reads a register with an access of 1, 2 or 4 bytes.
    fn read(&mut self, offset: u32, bytes: u32, wires: &mut Wires) -> u32;
    fn write(&mut self, offset: u32, value: u32, mask: u32, wires: &mut Wires);
}

/// A port in its state after a reset, by its number: `1` is SPI1.
pub(crate) fn new(unit: u8, mcu: &'static Mcu) -> Box<dyn Spi> {
    match mcu.block("SPI1") {
        "spi_v3_i2s" => Box::new(Unit::<v3::Version>::new(unit, mcu)),
        _ => Box::new(Unit::<v1::Version>::new(unit, mcu)),
    }
}

/// What the versions share: the place on the bus, and the wires.
#[derive(Debug)]
struct Place {
    unit: u8,
    mcu: &'static Mcu,
    irq: u16,
    is_on_apb2: bool,
    name: String,
    wires: [String; 3],
}

impl Place {
    fn new(unit: u8, mcu: &'static Mcu) -> Self {
        let name = format!("SPI{unit}");
        Self {
            unit,
            mcu,
            irq: mcu.irq(&name, "GLOBAL"),
            is_on_apb2: mcu.is_on_apb2(&name),
            wires: ["SCK", "MISO", "MOSI"].map(|wire| format!("{name}_{wire}")),
            name,
        }
    }

    fn clock_hz(&self, wires: &Wires) -> u64 {
        if self.is_on_apb2 { wires.clocks.apb2 } else { wires.clocks.apb1 }
    }

    fn state(&self, cr1: u32, wires: &Wires) -> Option<PortState> {
        let fastest_hz = self.clock_hz(wires) / 2;
        let clock_hz = fastest_hz >> (cr1 >> 3 & 7);
        let setting = Setting::Spi { clock_hz, fastest_hz, mode: (cr1 & 3) as u8 };
        (cr1 & MASTER != 0).then(|| PortState { unit: self.name.clone(), setting })
    }

    /// Sends a byte; returns the one that comes back.
    /// The levels of its output end at that time, and each of them lasts so many picoseconds.
    fn exchange(&self, byte: u8, (end_ps, bit_ps): (u64, u64), wires: &Wires) -> u8 {
        let [clock, input, output] = self.wires.each_ref().map(|wire| wires.pad_of(wire).is_some());
        if output {
            let from_ps = end_ps.saturating_sub(8 * bit_ps);
            wires.world(|world, _| world.levels(self.unit, byte, from_ps, bit_ps));
        }
        if !clock {
            return 0xFF;
        }
        // A wire that is not on any pad sends and receives nothing useful.
        let sent = if output { byte } else { 0xFF };
        let answer = wires.world(|world, now| world.spi(self.unit, sent, now));
        if input { answer } else { 0xFF }
    }

    fn report(&self, cr2: u32, sr: u32, wires: &mut Wires) {
        let holds = |enable: u32, flag: u32| cr2 & enable != 0 && sr & flag != 0;
        let is_held = holds(EMPTY_INTERRUPTS, EMPTY)
            || holds(RECEIVED_INTERRUPTS, RECEIVED)
            || holds(ERROR_INTERRUPTS, OVERRUN);
        wires.interrupt(self.irq, 0, is_held);
    }
}

/// What a version does in its own way: the items that wait, and those that have been received.
trait Version: Default + Send {
    /// CR2 after a reset.
    const CR2: u32;

    /// The bits of an item.
    fn bits(unit: &Unit<Self>) -> u64;
    fn sr(unit: &Unit<Self>) -> u32;
    /// The next item to send; `None` if none is complete.
    fn next(unit: &mut Unit<Self>) -> Option<u16>;
    /// Exchanges an item for another one, and keeps that.
    fn finish(unit: &mut Unit<Self>, item: u16, wires: &Wires);
    /// The program has read DR and then SR: the overrun is over.
    fn clear_overrun(&mut self);
    /// Reads DR with an access of that many bytes.
    fn take(unit: &mut Unit<Self>, bytes: u32) -> u32;
    /// Writes DR.
    fn put(unit: &mut Unit<Self>, value: u32, mask: u32);
}

/// An SPI port.
#[derive(Debug)]
struct Unit<V> {
    place: Place,
    cr: [u32; 2],
    other: [u32; 5],
    /// The item on the wires.
    shifting: Option<u16>,
    until: u64,
    /// When the last item ended.
    ended: u64,
    /// Whether DR was read with an overrun, which a read of SR then clears.
    has_read_data: bool,
    version: V,
}

impl<V: Version> Unit<V> {
    fn new(unit: u8, mcu: &'static Mcu) -> Self {
        Self {
            place: Place::new(unit, mcu),
            cr: [0, V::CR2],
            other: [7, 0, 0, 0, 2],
            shifting: None,
            until: NEVER,
            ended: 0,
            has_read_data: false,
            version: V::default(),
        }
    }

    fn begin(&mut self, at: u64, wires: &Wires) {
        self.until = NEVER;
        if self.cr[0] & (ENABLE | MASTER) != ENABLE | MASTER || self.shifting.is_some() {
            return;
        }
        self.shifting = V::next(self);
        if self.shifting.is_some() {
            let periods = V::bits(self) << ((self.cr[0] >> 3 & 7) + 1);
            self.until = at + periods_ns(periods, self.place.clock_hz(wires));
        }
    }

    /// Sends a byte of the item that has ended, behind which so many others come; returns the one that comes back.
    fn exchange(&self, byte: u8, others: u64, wires: &Wires) -> u8 {
        let periods = 1_000_000_000_000_u64 << ((self.cr[0] >> 3 & 7) + 1);
        let bit_ps = periods / self.place.clock_hz(wires).max(1);
        let end_ps = 1_000 * self.ended - 8 * bit_ps * others;
        self.place.exchange(byte, (end_ps, bit_ps), wires)
    }

    fn report(&self, wires: &mut Wires) {
        self.place.report(self.cr[1], V::sr(self), wires);
    }

    /// A register that holds what is written to it.
    fn setting(&mut self, offset: u32) -> Option<&mut u32> {
        match offset {
            0x00 | 0x04 => Some(&mut self.cr[(offset / 4) as usize]),
            0x10..=0x20 => Some(&mut self.other[((offset - 0x10) / 4) as usize]),
            _ => None,
        }
    }
}

impl<V: Version> Spi for Unit<V> {
    fn restart(&mut self, wires: &mut Wires) {
        *self = Self::new(self.place.unit, self.place.mcu);
        self.report(wires);
    }

    fn state(&self, wires: &Wires) -> Option<PortState> {
        self.place.state(self.cr[0], wires)
    }

    fn deadline(&self) -> u64 {
        self.until
    }

    fn advance(&mut self, wires: &mut Wires) {
        while self.until <= wires.now {
            let at = self.until;
            let Some(item) = self.shifting.take() else { break };
            self.ended = at;
            V::finish(self, item, wires);
            self.begin(at, wires);
        }
        self.report(wires);
    }

    fn asks(&self, transmits: bool) -> bool {
        let is_ready = |enable: u32, flag: u32| self.cr[1] & enable != 0 && V::sr(self) & flag != 0;
        if transmits {
            is_ready(TRANSMITS_BY_DMA, EMPTY) && self.cr[0] & ENABLE != 0
        } else {
            is_ready(RECEIVES_BY_DMA, RECEIVED)
        }
    }

    fn read(&mut self, offset: u32, bytes: u32, wires: &mut Wires) -> u32 {
        let value = match offset {
            0x08 => {
                let value = V::sr(self);
                if std::mem::take(&mut self.has_read_data) {
                    self.version.clear_overrun();
                }
                value
            }
            0x0C => V::take(self, bytes),
            _ => self.setting(offset).map_or(0, |register| *register),
        };
        self.report(wires);
        value
    }

    fn write(&mut self, offset: u32, value: u32, mask: u32, wires: &mut Wires) {
        if offset == 0x0C {
            V::put(self, value, mask);
        } else if let Some(register) = self.setting(offset) {
            *register = merge(*register, value, mask);
        }
        if self.until == NEVER {
            self.begin(wires.now, wires);
        }
        self.report(wires);
    }
}
