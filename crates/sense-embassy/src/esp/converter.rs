//! The converter, which takes one sample at a time, and corrects each by what the chip's maker measured.

use embassy_futures::yield_now;
use embassy_time::{Duration, Timer};
use esp_hal::Blocking;
use esp_hal::analog::adc::{
    Adc, AdcCalCurve, AdcCalScheme as _, AdcChannel, AdcConfig, Attenuation, RegisterAccess,
};
use esp_hal::gpio::AnalogPin;
use esp_hal::peripherals::ADC1;

/// All inputs reach as far up as they can.
const RANGE: Attenuation = Attenuation::_11dB;
/// The supply, and the greatest sample of 12 bits.
const SUPPLY_MV: u32 = 3_300;
const SAMPLE_MAX: u32 = 4_095;
/// How long a start takes until there can be another one.
const BETWEEN_STARTS: Duration = Duration::from_micros(40);

/// The converter, whose clock runs as long as it is there.
pub struct Converter {
    _unit: Adc<'static, ADC1<'static>, Blocking>,
    starts: u8,
}

/// An input: its channel, and what corrects its samples.
pub struct Input {
    channel: u8,
    correction: AdcCalCurve<ADC1<'static>>,
}

impl Input {
    /// A pin as an input.
    pub fn new(pin: impl AdcChannel + AnalogPin) -> Self {
        let pin = AdcConfig::<ADC1<'static>>::new()
            .enable_pin_with_cal::<_, AdcCalCurve<ADC1<'static>>>(pin, RANGE);
        Self { channel: pin.pin.adc_channel(), correction: pin.cal_scheme }
    }
}

impl Converter {
    /// The converter. `starts`: how often a conversion must be started until there is one.
    #[must_use]
    pub fn new(unit: ADC1<'static>, starts: u8) -> Self {
        Self { _unit: Adc::new(unit, AdcConfig::new()), starts }
    }

    /// Takes a sample of 12 bits, of which the greatest is the supply of 3.3 V, as everywhere else. What is above the
    /// range of the converter is as high as that.
    pub async fn read(&mut self, input: &mut Input, sample: &mut u16) {
        type Unit = ADC1<'static>;
        Unit::calibration_init();
        Unit::set_init_code(input.correction.adc_cal());
        Unit::config_onetime_sample(input.channel, RANGE as u8);
        Unit::start_onetime_sample();
        for _ in 1..self.starts {
            Timer::after(BETWEEN_STARTS).await;
            Unit::start_onetime_sample();
        }
        // One that never ends is found by the watchdog, as its task hangs.
        while !Unit::is_done() {
            yield_now().await;
        }
        let millivolts = u32::from(input.correction.adc_val(Unit::read_data()));
        Unit::reset();
        let value = (millivolts * SAMPLE_MAX + SUPPLY_MV / 2) / SUPPLY_MV;
        *sample = u16::try_from(value.min(SAMPLE_MAX)).unwrap_or(u16::MAX);
    }
}
