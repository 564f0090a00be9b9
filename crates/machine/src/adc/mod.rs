//! The analog-to-digital converters, with a file for each version of the block: regular sequences with DMA, injected
//! ones by software.
//!
//! In: writes to the registers, triggers of timers, voltages on pads. Out: samples, requests to the DMA, interrupts.

mod f1;
mod g4;
mod older;
mod unit;
mod v2;

use std::collections::BTreeMap;

pub(crate) use self::unit::Adc;
use crate::mcu::Mcu;
use crate::registers::merge;

/// A converter in its state after a reset, by its number: `1` is ADC1.
pub(crate) fn new(block: &str, unit: u8) -> Box<dyn Adc> {
    match block {
        "adc_f1" => Box::new(older::Unit::<f1::Version>::new(unit)),
        "adc_g4" => Box::new(g4::Unit::new(unit)),
        _ => Box::new(older::Unit::<v2::Version>::new(unit)),
    }
}

/// The registers that converters of an MCU share, by the first of these.
pub(crate) fn commons(mcu: &Mcu) -> BTreeMap<usize, Common> {
    mcu.adc_commons().map(|(first, name, block)| (first, Common::new(name, block))).collect()
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
    fn new(name: &str, block: &str) -> Self {
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
