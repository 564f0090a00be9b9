//! Pulse widths.

use embassy_rp::pwm::{Config, Pwm};
use fixed::FixedU16;
use sense_rt::pulse_counts;

/// The greatest divider of a slice's clock.
const DIVIDER: u32 = 255;

/// A slice with its two outputs.
pub struct Slice {
    slice: Pwm<'static>,
    config: Config,
}

/// A slice that counts from 0 to `top` with a step each `divider` clocks.
pub fn config(divider: u8, top: u16) -> Config {
    let mut config = Config::default();
    config.divider = FixedU16::from_bits(u16::from(divider) << 4);
    config.top = top;
    config
}

impl Slice {
    /// A slice that is set up as `config` says.
    #[must_use]
    pub fn new(slice: Pwm<'static>, config: Config) -> Self {
        Self { slice, config }
    }

    /// Sets the pulse of a level at output 1 (A) or 2 (B), from the least to the greatest of `[least, greatest,
    /// period]` in any unit. It is that from the period after [`Slice::apply`] on.
    pub fn set(&mut self, output: u8, pulse: [u32; 3], level: u32) {
        let compare = pulse_counts(u32::from(self.config.top) + 1, pulse, level);
        let compare = u16::try_from(compare).unwrap_or(u16::MAX);
        if output == 1 {
            self.config.compare_a = compare;
        } else {
            self.config.compare_b = compare;
        }
    }

    /// Turns output 1 (A) or 2 (B) off at once: it ends the period, which may be shorter than others for that.
    pub fn stop(&mut self, output: u8) {
        let own = if output == 1 { self.config.compare_a } else { self.config.compare_b };
        if own == 0 {
            return;
        }
        self.set(output, [0, 0, 1], 0);
        self.apply();
        self.slice.set_counter(self.config.top);
        // The period ends with the slice's next step, at most 255 clocks later.
        for _ in 0..DIVIDER {
            if self.slice.counter() != self.config.top {
                break;
            }
        }
    }

    /// Hands the pulses of both outputs over at once.
    pub fn apply(&mut self) {
        self.slice.set_config(&self.config);
    }
}
