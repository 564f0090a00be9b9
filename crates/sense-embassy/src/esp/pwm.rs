//! Pulse widths: a timer of the LED controller with the two channels behind it.

use esp_hal::gpio::{AnyPin, DriveMode, NoPin};
use esp_hal::ledc::channel::{self, Channel, ChannelHW as _, ChannelIFace as _};
use esp_hal::ledc::timer::config::{Config, Duty};
use esp_hal::ledc::timer::{self, LSClockSource, TimerIFace};
use esp_hal::ledc::{LSGlobalClkSource, Ledc, LowSpeed};
use esp_hal::peripherals::LEDC;
use esp_hal::time::Rate;
use sense_rt::pulse_counts;

/// A timer of the controller; it is a `static`. The HAL's own takes the clock of the bus for that of the controller,
/// which on ESP32-C6 has twice as much.
pub struct Timer {
    number: timer::Number,
    duty: Duty,
}

/// The timer of a number whose periods have `1 << bits` steps. `divisor` is how many times 256 a step is longer than
/// a period of the controller's clock of 80 MHz.
pub fn timer(number: u8, bits: u8, divisor: u32) -> Timer {
    let duty = match bits {
        0 | 1 => Duty::Duty1Bit,
        2 => Duty::Duty2Bit,
        3 => Duty::Duty3Bit,
        4 => Duty::Duty4Bit,
        5 => Duty::Duty5Bit,
        6 => Duty::Duty6Bit,
        7 => Duty::Duty7Bit,
        8 => Duty::Duty8Bit,
        9 => Duty::Duty9Bit,
        10 => Duty::Duty10Bit,
        11 => Duty::Duty11Bit,
        12 => Duty::Duty12Bit,
        13 => Duty::Duty13Bit,
        _ => Duty::Duty14Bit,
    };
    // SAFETY: the timers and channels of the controller are handed out one by one, and it is taken by nobody else.
    let mut unit = Ledc::new(unsafe { LEDC::steal() });
    unit.set_global_slow_clock(LSGlobalClkSource::APBClk);
    let registers = LEDC::regs().timer(usize::from(number));
    registers.conf().modify(|_, conf| {
        conf.rst().clear_bit();
        conf.pause().clear_bit();
        // SAFETY: any bits are a divisor and a number of bits.
        unsafe { conf.clk_div().bits(divisor).duty_res().bits(duty as u8) }
    });
    registers.conf().modify(|_, conf| conf.para_up().set_bit());
    let number = match number {
        0 => timer::Number::Timer0,
        1 => timer::Number::Timer1,
        2 => timer::Number::Timer2,
        _ => timer::Number::Timer3,
    };
    Timer { number, duty }
}

impl TimerIFace<LowSpeed> for Timer {
    fn freq(&self) -> Option<Rate> {
        None
    }

    /// It is set already.
    fn configure(&mut self, _: Config<LSClockSource>) -> Result<(), timer::Error> {
        Ok(())
    }

    fn is_configured(&self) -> bool {
        true
    }

    fn duty(&self) -> Option<Duty> {
        Some(self.duty)
    }

    fn number(&self) -> timer::Number {
        self.number
    }

    /// Fades ask for it, of which there are none.
    fn frequency(&self) -> u32 {
        0
    }
}

/// Outputs of a timer.
pub struct Pulses {
    counts: u32,
}

impl Pulses {
    /// The outputs of a timer whose periods have `1 << bits` steps: channels with their pins, which are low at first.
    pub fn new(
        timer: &'static mut Timer,
        bits: u8,
        outputs: [Option<(u8, AnyPin<'static>)>; 2],
    ) -> Self {
        let timer: &'static Timer = timer;
        for (number, pin) in outputs.into_iter().flatten() {
            let mut channel = Channel::new(channel_number(number), pin);
            let drive_mode = DriveMode::PushPull;
            if channel
                .configure(channel::config::Config { timer, duty_pct: 0, drive_mode })
                .is_err()
            {
                crate::restart();
            }
        }
        Self { counts: 1 << bits }
    }

    /// Sets the pulse of a level on a channel, from the least to the greatest of `[least, greatest, period]` in any
    /// unit. It is that from the next period on.
    pub fn set(&mut self, channel: u8, pulse: [u32; 3], level: u32) {
        let duty = pulse_counts(self.counts, pulse, level);
        Channel::<LowSpeed>::new(channel_number(channel), NoPin).set_duty_hw(duty);
    }
}

fn channel_number(number: u8) -> channel::Number {
    match number {
        0 => channel::Number::Channel0,
        1 => channel::Number::Channel1,
        2 => channel::Number::Channel2,
        3 => channel::Number::Channel3,
        4 => channel::Number::Channel4,
        _ => channel::Number::Channel5,
    }
}
