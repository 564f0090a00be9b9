//! SPI ports as masters, with a file for each version of the block.
//!
//! In: accesses of the program, and the answers of the chips on the bus. Out: bytes, at the bus's speed, interrupts,
//! requests to the DMA.

mod v1;
mod v3;

use crate::mcu::Mcu;
use crate::ports::{PortState, Setting};
use crate::wires::Wires;

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

/// A port, in one of the block's versions.
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
        "spi_v3_i2s" => Box::new(v3::Unit::new(unit, mcu)),
        _ => Box::new(v1::Unit::new(unit, mcu)),
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
    fn exchange(&self, byte: u8, wires: &Wires) -> u8 {
        let [clock, input, output] = self.wires.each_ref().map(|wire| wires.pad_of(wire).is_some());
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
