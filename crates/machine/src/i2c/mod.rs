//! I2C buses, with a file for each version of the block. Only masters are modelled.
//!
//! In: accesses of the program, and replies of the chips on the bus. Out: the bus's activity, to the bit's time,
//! interrupts, requests to the DMA.

mod v1;
mod v2;

use crate::mcu::Mcu;
use crate::ports::PortState;
use crate::wires::Wires;

/// A bus, in one of the block's versions.
pub(crate) trait I2c: Send {
    /// Restarts it in its state after a reset.
    fn restart(&mut self, wires: &mut Wires);
    /// Its settings, once it has started.
    fn state(&self, wires: &Wires) -> Option<PortState>;
    fn deadline(&self) -> u64;
    fn advance(&mut self, wires: &mut Wires);
    /// Whether it requests a transfer by the DMA.
    fn asks(&self, transmits: bool) -> bool;
    fn read(&mut self, offset: u32, wires: &mut Wires) -> u32;
    fn write(&mut self, offset: u32, value: u32, mask: u32, wires: &mut Wires);
}

/// A bus in its state after a reset, by its number: `1` is I2C1.
pub(crate) fn new(unit: u8, mcu: &'static Mcu) -> Box<dyn I2c> {
    match mcu.block("I2C1") {
        "i2c_v2" => Box::new(v2::Unit::new(unit, mcu)),
        _ => Box::new(v1::Unit::new(unit, mcu)),
    }
}

/// Whether one of a bus's wires is low although the unit does not drive it, or is not on any pad.
fn is_held(lines: &[String; 2], wires: &Wires) -> bool {
    let is_low = |wire: &String| match wires.pad_of(wire) {
        Some(pad) => wires.world(|world, now| world.level(pad, now)) == Some(false),
        None => true,
    };
    lines.iter().any(is_low)
}
