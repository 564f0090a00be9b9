//! The converter, which is set up for each input anew.

use embassy_nrf::Peri;
use embassy_nrf::interrupt::typelevel::{Binding, SAADC as Interrupt};
use embassy_nrf::peripherals::SAADC;
use embassy_nrf::saadc::{
    AnyInput, ChannelConfig, Config, Gain, InterruptHandler, Reference, Resolution, Saadc, Time,
};

/// The converter. `I` binds its interrupt.
pub struct Converter<I> {
    unit: Peri<'static, SAADC>,
    interrupts: I,
}

impl<I: Binding<Interrupt, InterruptHandler> + Copy + 'static> Converter<I> {
    /// The converter, with the interrupts of the program.
    #[must_use]
    pub fn new(unit: Peri<'static, SAADC>, interrupts: I) -> Self {
        Self { unit, interrupts }
    }

    /// Takes a sample of 12 bits, of which the greatest is the supply: as everywhere else, the input is compared with
    /// it, and not with the voltage that the MCU has of its own.
    pub async fn read(&mut self, input: &mut AnyInput<'static>, time_us: u32, sample: &mut u16) {
        let mut channel = ChannelConfig::single_ended(input.reborrow());
        channel.reference = Reference::VDD1_4;
        channel.gain = Gain::Gain1_4;
        channel.time = time(time_us);
        let mut config = Config::default();
        config.resolution = Resolution::_12bit;
        let mut unit = Saadc::new(self.unit.reborrow(), self.interrupts, config, [channel]);
        let mut value = [0];
        unit.sample(&mut value).await;
        // A little below 0 V, a value is less than 0.
        *sample = u16::try_from(value[0]).unwrap_or(0);
    }
}

/// The time that a sample takes from its input.
fn time(us: u32) -> Time {
    match us {
        0..=3 => Time::_3US,
        4..=5 => Time::_5US,
        6..=10 => Time::_10US,
        11..=15 => Time::_15US,
        16..=20 => Time::_20US,
        _ => Time::_40US,
    }
}
