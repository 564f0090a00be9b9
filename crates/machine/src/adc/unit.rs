//! What the versions of the converter have in common.
//!
//! In: voltages on pads, and the registers that say which channels are converted. Out: what the chip asks of a
//! converter, as a trait, and the numbers that voltages become.

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

/// The channel at a place of a sequence, from SQR1 to SQR3.
pub(super) fn channel_at(sqr: [u32; 3], at: u32) -> u32 {
    match at {
        0..=5 => sqr[2] >> (5 * at) & 31,
        6..=11 => sqr[1] >> (5 * (at - 6)) & 31,
        _ => sqr[0] >> (5 * (at - 12)) & 31,
    }
}

/// The channels of an injected sequence, from JSQR.
pub(super) fn injected(jsqr: u32) -> impl Iterator<Item = u32> {
    let length = (jsqr >> 20 & 3) + 1;
    (0..length).map(move |index| jsqr >> (5 * (4 - length + index)) & 31)
}

/// The code of a channel's sampling time, from SMPR1 and SMPR2.
pub(super) fn sampling(smpr: [u32; 2], channel: u32) -> usize {
    let code = match channel {
        0..=9 => smpr[1] >> (3 * channel) & 7,
        _ => smpr[0] >> (3 * (channel.min(18) - 10)) & 7,
    };
    code as usize
}
