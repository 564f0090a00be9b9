//! What the versions of the converter have in common.
//!
//! In: voltages on pads. Out: what the chip asks of a converter, as a trait, and the numbers that voltages become.

use crate::wires::{SUPPLY_MV, Wires};

/// A converter.
pub(crate) trait Adc: Send {
    fn deadline(&self) -> u64;
    fn advance(&mut self, wires: &Wires);
    /// Starts the sequence if it waits for one of these timers' trigger outputs, one bit each.
    fn trigger(&mut self, triggers: u32, wires: &Wires);
    /// Whether a sample waits for the DMA.
    fn asks(&self) -> bool;
    /// The DMA moved the last item.
    fn dma_ended(&mut self);
    fn interrupts(&self) -> bool;
    fn read(&mut self, offset: u32) -> u32;
    fn write(&mut self, offset: u32, value: u32, mask: u32, wires: &Wires);

    /// The bits of this converter in the status register that all of them share, if there is one.
    fn status(&self) -> u32 {
        0
    }

    /// Takes the control register that they share, if there is one.
    fn share(&mut self, _: u32) {}
}

/// What a converter makes of the voltage on an input from outside.
pub(super) fn input_mv(unit: u8, channel: u32, wires: &Wires) -> f64 {
    let pad = wires.pad_of(&format!("ADC{unit}_IN{channel}"));
    pad.map_or(0.0, |pad| wires.world(|world, now| world.millivolts(pad, now)))
}

/// A voltage as a number with so many bits.
pub(super) fn code_of(millivolts: f64, bits: u64) -> u32 {
    let steps = f64::from(1_u32 << bits);
    let code = (millivolts / SUPPLY_MV * steps).floor().clamp(0.0, steps - 1.0);
    // The clamped value is a small whole number.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 4095")]
    let code = code as u32;
    code
}
