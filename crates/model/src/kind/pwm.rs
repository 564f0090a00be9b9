//! `pwm`: a pulse width on a timer output; values from 0 to 10,000 map to pulses from `min` to
//! `max`.

use super::role::Role;
use super::spec::{KindSpec, Properties, Serves, Sharing, Values};
use crate::fields::{Codes, Fields};
use crate::meaning::{Meaning, Takes};
use sensedsl_board::signal::Function;
use sensedsl_wire::{Direction, ScalarType, ValueType};

/// The properties that all devices of this kind share.
pub const SPEC: KindSpec = KindSpec {
    name: "pwm",
    article: "a",
    directions: &[Direction::Actuator],
    values: Values::OneNumber,
    properties: &["frequency", "min", "max", "failsafe", "pin"],
    sharing: Sharing::Own,
    triggers_itself: false,
    codes: Some((0.0, FULL)),
    natural: ScalarType::Uint16,
    inputs_have: &[],
    of_part: &[],
    serves: Serves::Signal(serves),
    wires: "one timer output; outputs of one timer share its frequency",
    example: "",
    colour: "#FF8822",
    colour_on_dark: "#B24C00",
    letter: 'P',
};

/// What its properties mean, besides those that fix wires.
pub(crate) const MEANINGS: &[Meaning] = &[
    Meaning::new(
        ("frequency", Takes::Frequency(1, 1_000_000)),
        "50 Hz",
        "Pulses per second; the outputs of one timer share it.",
        "frequency = 20 kHz;",
    ),
    Meaning::new(("min", Takes::Pulse), "0", "The pulse of the least value, 0.", "min = 1 ms;"),
    Meaning::new(
        ("max", Takes::Pulse),
        "the period",
        "The pulse of the greatest value, 10000.",
        "max = 2 ms;",
    ),
    Meaning::new(
        ("failsafe", Takes::Shown),
        "keep the last",
        "What the output becomes when the host falls silent: 0 to 10000, a percentage, or a pulse. The pulses \
         begin with it at the start.",
        "failsafe = 1500 us;",
    ),
];

/// Pulses per second if the file gives none: the frequency of a model servo.
const FREQUENCY_DEFAULT_HZ: u32 = 50;
/// The code of the pulse `max`, and of an output that is always on.
pub(crate) const FULL: f64 = 10_000.0;

/// A timer output.
#[derive(Clone, Debug, PartialEq)]
pub struct Pwm {
    /// Pulses per second; the outputs of a timer share it.
    pub frequency_hz: u32,
    /// Pulse for the least value; none for 0.
    pub min_us: Option<u32>,
    /// Pulse for the greatest value; none for the whole period.
    pub max_us: Option<u32>,
    /// The value taken when the host goes silent; none to keep the last one.
    pub failsafe: Option<f64>,
}

fn serves(_: Role, function: &Function) -> bool {
    matches!(function, Function::Timer { line, .. } if line.is_output() || !line.is_input())
}

impl Properties for Pwm {
    fn read(fields: &mut Fields<'_>, _: Direction, value: ValueType) -> Self {
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
        let (min_us, max_us) = (min.map(|time| time.value), max.map(|time| time.value));
        let pulses_us = (min_us.unwrap_or(0).into(), max_us.unwrap_or(period_us).into());
        // For a bridge, the sign is the direction.
        let least = if fields.is_of_reading() { -FULL } else { 0.0 };
        let codes = Codes {
            range: Some((least, FULL)),
            is_whole: value.scalar.integer_range().is_some(),
            pulses_us: Some(pulses_us),
        };
        let failsafe = fields.code("failsafe", codes).map(|code| code.value);
        Self { frequency_hz, min_us, max_us, failsafe }
    }

    fn plain(_: u8) -> Self {
        Self::default()
    }

    fn roles(&self, _: Direction) -> Vec<Role> {
        vec![Role::Out]
    }
}

impl Default for Pwm {
    fn default() -> Self {
        Self { frequency_hz: FREQUENCY_DEFAULT_HZ, min_us: None, max_us: None, failsafe: None }
    }
}
