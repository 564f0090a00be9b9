//! `pwm`: a pulse width on a timer output; the value goes from 0 to 10,000 between `min` and `max`.

use crate::fields::Fields;

/// The properties of this kind.
pub const PROPERTIES: &[&str] = &["frequency", "min", "max", "failsafe", "pin"];

/// Pulses per second where the file says nothing: that of a model servo.
const FREQUENCY_DEFAULT_HZ: u32 = 50;

/// A timer output.
#[derive(Clone, Debug, PartialEq)]
pub struct Pwm {
    /// Pulses per second; outputs of one timer share it.
    pub frequency_hz: u32,
    /// Pulse of the least value; none for 0.
    pub min_us: Option<u32>,
    /// Pulse of the greatest value; none for the whole period.
    pub max_us: Option<u32>,
    /// The value taken when the host falls silent; none to keep the last one.
    pub failsafe: Option<f64>,
}

pub(crate) fn read(fields: &mut Fields<'_>) -> Pwm {
    let frequency = fields.frequency_hz("frequency", 1..=1_000_000);
    let frequency_hz = frequency.map_or(FREQUENCY_DEFAULT_HZ, |frequency| frequency.value);
    let period_us = 1_000_000 / frequency_hz.max(1);
    let min = fields.time_us("min", 0..=period_us);
    let max = fields.time_us("max", 0..=period_us);
    if let (Some(min), Some(max)) = (min, max)
        && min.value >= max.value
    {
        fields.contradiction(min.span, "max", "`min` is not below `max`");
    }
    Pwm {
        frequency_hz,
        min_us: min.map(|time| time.value),
        max_us: max.map(|time| time.value),
        failsafe: fields.number("failsafe").map(|number| number.value),
    }
}

impl Default for Pwm {
    fn default() -> Self {
        Self { frequency_hz: FREQUENCY_DEFAULT_HZ, min_us: None, max_us: None, failsafe: None }
    }
}
