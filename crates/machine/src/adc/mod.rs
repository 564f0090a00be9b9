//! The analog-to-digital converters, with a file for each version of the block: regular sequences with DMA, injected
//! ones by software.
//!
//! In: writes to the registers, triggers of timers, voltages on pads. Out: samples, requests to the DMA, interrupts.

mod f1;
mod g4;
mod v2;

use crate::wires::{SUPPLY_MV, Wires, merge};

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

/// A converter in its state after a reset, by its number: `1` is ADC1.
pub(crate) fn new(block: &str, unit: u8) -> Box<dyn Adc> {
    match block {
        "adc_f1" => Box::new(f1::Unit::new(unit)),
        "adc_g4" => Box::new(g4::Unit::new(unit)),
        _ => Box::new(v2::Unit::new(unit)),
    }
}

/// Registers that several converters share.
#[derive(Debug)]
pub(crate) struct Common {
    /// The converters, counted from 0.
    pub members: Vec<usize>,
    /// The offset of the control register, and the bits of each converter in the status register.
    control_at: u32,
    status_bits: u32,
    control: u32,
}

impl Common {
    /// The registers of a block, such as `ADC345_COMMON`, in their state after a reset.
    pub(crate) fn new(name: &str, block: &str) -> Self {
        let numbers = name.chars().filter_map(|letter| letter.to_digit(10));
        let members = numbers.filter_map(|number| (number as usize).checked_sub(1)).collect();
        let (control_at, status_bits) =
            if block == "adccommon_g4" { (0x08, 16) } else { (0x04, 8) };
        Self { members, control_at, status_bits, control: 0 }
    }

    pub(crate) fn read(&self, offset: u32, adcs: &[Box<dyn Adc>]) -> u32 {
        if offset == self.control_at {
            return self.control;
        }
        let statuses = self.members.iter().filter_map(|at| adcs.get(*at)).map(|adc| adc.status());
        let shifts = (0..).step_by(self.status_bits as usize);
        let parts = statuses.zip(shifts).filter(|(_, shift)| *shift < u32::BITS);
        if offset == 0 { parts.fold(0, |all, (status, shift)| all | status << shift) } else { 0 }
    }

    pub(crate) fn write(&mut self, offset: u32, value: u32, mask: u32, adcs: &mut [Box<dyn Adc>]) {
        if offset == self.control_at {
            self.control = merge(self.control, value, mask);
            self.share(adcs);
        }
    }

    /// Resets all its converters.
    pub(crate) fn restart(&mut self, block: &str, adcs: &mut [Box<dyn Adc>]) {
        self.control = 0;
        for at in &self.members {
            if let (Some(adc), Ok(unit)) = (adcs.get_mut(*at), u8::try_from(*at + 1)) {
                *adc = new(block, unit);
            }
        }
    }

    fn share(&self, adcs: &mut [Box<dyn Adc>]) {
        for at in &self.members {
            if let Some(adc) = adcs.get_mut(*at) {
                adc.share(self.control);
            }
        }
    }
}

/// What a converter makes of the voltage on an input from outside.
fn input_mv(unit: u8, channel: u32, wires: &Wires) -> f64 {
    let pad = wires.pad_of(&format!("ADC{unit}_IN{channel}"));
    pad.map_or(0.0, |pad| wires.world(|world, now| world.millivolts(pad, now)))
}

/// A voltage as a number with so many bits.
fn code_of(millivolts: f64, bits: u64) -> u32 {
    let steps = f64::from(1_u32 << bits);
    let code = (millivolts / SUPPLY_MV * steps).floor().clamp(0.0, steps - 1.0);
    // The clamped value is a small whole number.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 4095")]
    let code = code as u32;
    code
}

/// The channel at a place of a sequence, from SQR1 to SQR3.
fn channel_at(sqr: [u32; 3], at: u32) -> u32 {
    match at {
        0..=5 => sqr[2] >> (5 * at) & 31,
        6..=11 => sqr[1] >> (5 * (at - 6)) & 31,
        _ => sqr[0] >> (5 * (at - 12)) & 31,
    }
}

/// The channels of an injected sequence, from JSQR.
fn injected(jsqr: u32) -> impl Iterator<Item = u32> {
    let length = (jsqr >> 20 & 3) + 1;
    (0..length).map(move |index| jsqr >> (5 * (4 - length + index)) & 31)
}

/// The code of a channel's sampling time, from SMPR1 and SMPR2.
fn sampling(smpr: [u32; 2], channel: u32) -> usize {
    let code = match channel {
        0..=9 => smpr[1] >> (3 * channel) & 7,
        _ => smpr[0] >> (3 * (channel.min(18) - 10)) & 7,
    };
    code as usize
}
