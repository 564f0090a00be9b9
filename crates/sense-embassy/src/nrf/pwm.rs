//! Pulse widths.

use core::sync::atomic::{Ordering, compiler_fence};

use embassy_nrf::pac::pwm::Pwm as Registers;
use embassy_nrf::pwm::{Prescaler, SimpleConfig, SimplePwm};
use sense_rt::pulse_counts;

/// Marks a duty that an output begins its period with: it is high while the unit counts up to it.
const HIGH_FIRST: u16 = 0x8000;

/// A unit with up to four outputs, which change together.
pub struct Pulses {
    /// It has the pins. The HAL's own call waits for the end of a period, which interrupts cannot.
    _unit: SimplePwm<'static>,
    registers: Registers,
    /// The channel of the design that each output has, from 1.
    channels: [u8; 4],
    /// What the unit fetches at the beginning of a period.
    duties: [u16; 4],
    counts: u16,
}

/// A unit that counts `counts` steps in a period, with a step each `1 << power` clocks.
#[must_use]
pub fn config(power: u8, counts: u16) -> SimpleConfig {
    let mut config = SimpleConfig::default();
    config.max_duty = counts;
    config.prescaler = match power {
        0 => Prescaler::Div1,
        1 => Prescaler::Div2,
        2 => Prescaler::Div4,
        3 => Prescaler::Div8,
        4 => Prescaler::Div16,
        5 => Prescaler::Div32,
        6 => Prescaler::Div64,
        _ => Prescaler::Div128,
    };
    config
}

impl Pulses {
    /// A unit with its registers, whose outputs have these channels; what is no output has channel 0.
    #[must_use]
    pub fn new(unit: SimplePwm<'static>, registers: Registers, channels: [u8; 4]) -> Self {
        let counts = unit.max_duty();
        Self { _unit: unit, registers, channels, duties: [HIGH_FIRST; 4], counts }
    }

    /// Sets the pulse of a level on a channel, from the least to the greatest of `[least, greatest, period]` in any
    /// unit. It is that from the period after [`Pulses::apply`] on.
    pub fn set(&mut self, channel: u8, pulse: [u32; 3], level: u32) {
        let duty = pulse_counts(self.counts.into(), pulse, level);
        let duty = HIGH_FIRST | u16::try_from(duty).unwrap_or(self.counts);
        for (own, place) in self.channels.iter().zip(&mut self.duties) {
            if *own == channel {
                *place = duty;
            }
        }
    }

    /// Hands the pulses of all outputs over at once.
    pub fn apply(&mut self) {
        self.registers.dma().seq(0).ptr().write_value(self.duties.as_ptr() as u32);
        compiler_fence(Ordering::SeqCst);
        self.registers.tasks_dma().seq(0).start().write_value(1);
    }
}
