//! `stepper`: the driver of a stepper motor that takes pulses, a step each, and a level for the direction.

use super::role::Role;
use super::spec::{KindSpec, Properties, Serves, Sharing, Values};
use crate::fields::Fields;
use crate::meaning::{Meaning, Takes, first};
use sensedsl_board::signal::Function;
use sensedsl_wire::{Direction, ScalarType, ValueType};

/// The properties that all devices of this kind share.
pub const SPEC: KindSpec = KindSpec {
    name: "stepper",
    article: "a",
    directions: &[Direction::Actuator],
    values: Values::OneNumber,
    properties: &[
        "mode",
        "speed",
        "acceleration",
        "pulse",
        "forward",
        "enabled",
        "step",
        "dir",
        "enable",
    ],
    sharing: Sharing::Own,
    triggers_itself: true,
    codes: None,
    natural: ScalarType::Int32,
    inputs_have: &[],
    of_part: &[],
    serves: Serves::Signal(serves),
    wires: "one timer output for the steps; the whole timer is taken. A GPIO for the direction, and one for `enable` where there is that wire",
    example: "speed = 4000; acceleration = 40000;",
    colour: "#500080",
    colour_on_dark: "#632DFC",
    letter: 'M',
};

/// What its properties mean, besides those that fix wires.
pub(crate) const MEANINGS: &[Meaning] = &[
    Meaning::new(
        ("mode", Takes::Words(|| first(&MODES))),
        "`position`",
        "What a value is: `position`: the step to go to; `velocity`: steps per second, negative backwards.",
        "mode = velocity;",
    ),
    Meaning::new(
        ("speed", Takes::Whole(1, 500_000)),
        "1000",
        "The greatest speed, in steps (microsteps, where the driver makes them) per second.",
        "speed = 4000;",
    ),
    Meaning::new(
        ("acceleration", Takes::Whole(1, 10_000_000)),
        "2000",
        "How fast the speed grows and falls, in steps per second squared.",
        "acceleration = 8000;",
    ),
    Meaning::new(
        ("pulse", Takes::Time(1, 1_000)),
        "5 us",
        "How long a step's pulse lasts at least.",
        "pulse = 2 us;",
    ),
    Meaning::new(
        ("forward", Takes::Words(|| first(&LEVELS))),
        "`high`",
        "The level of the wire `dir` while the position grows.",
        "forward = low;",
    ),
    Meaning::new(
        ("enabled", Takes::Words(|| first(&LEVELS))),
        "`low` with `enable`, else none",
        "The level of the wire `enable` that lets current into the motor, from the first command on. With it there is \
         that wire, unless `enable = none`.",
        "enabled = low;",
    ),
];

/// What a value is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Mode {
    /// The step to go to.
    #[default]
    Position,
    /// Steps per second.
    Velocity,
}

/// The words after `mode`.
const MODES: [(&str, Mode); 2] = [("position", Mode::Position), ("velocity", Mode::Velocity)];
/// The words after `forward` and `enabled`, and whether the level is high.
const LEVELS: [(&str, bool); 2] = [("high", true), ("low", false)];

/// A stepper motor behind its driver.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Stepper {
    /// What a value is.
    pub mode: Mode,
    /// The greatest speed, in steps per second.
    pub speed: u32,
    /// Where the file gives it.
    pub speed_span: Option<sensedsl_diagnostics::Span>,
    /// In steps per second squared.
    pub acceleration: u32,
    /// The shortest pulse of a step.
    pub pulse_us: u32,
    /// Whether `dir` is high while the position grows.
    pub is_forward_high: bool,
    /// The level of `enable` that lets current into the motor; none without that wire.
    pub enabled: Option<bool>,
}

fn serves(_: Role, function: &Function) -> bool {
    matches!(function, Function::Timer { line, .. } if line.is_output() || !line.is_input())
}

impl Properties for Stepper {
    fn read(fields: &mut Fields<'_>, _: Direction, _: ValueType) -> Self {
        let own = Self::default();
        let mut small = |name: &str, most: i64| {
            let read = fields.integer(name, 1..=most)?;
            Some((u32::try_from(read.value).ok()?, read.span))
        };
        let (speed, acceleration) = (small("speed", 500_000), small("acceleration", 10_000_000));
        let mode = fields.word("mode", &MODES);
        let pulse = fields.time_us("pulse", 1..=1_000);
        let forward = fields.word("forward", &LEVELS);
        let enabled = fields.word("enabled", &LEVELS).map(|level| level.value);
        let is_without = fields.take_word_if("enable", "none");
        let named = fields.has("enable").then_some(false);
        Self {
            mode: mode.map(|mode| mode.value).unwrap_or_default(),
            speed: speed.map_or(own.speed, |(speed, _)| speed),
            speed_span: speed.map(|(_, span)| span),
            acceleration: acceleration.map_or(own.acceleration, |(number, _)| number),
            pulse_us: pulse.map_or(own.pulse_us, |pulse| pulse.value),
            is_forward_high: forward.is_none_or(|level| level.value),
            enabled: if is_without { None } else { enabled.or(named) },
        }
    }

    fn plain(_: u8) -> Self {
        Self::default()
    }

    fn roles(&self, _: Direction) -> Vec<Role> {
        let enable = self.enabled.map(|_| Role::Enable);
        [Role::Step, Role::Dir].into_iter().chain(enable).collect()
    }
}

impl Default for Stepper {
    fn default() -> Self {
        Self {
            mode: Mode::default(),
            speed: 1_000,
            speed_span: None,
            acceleration: 2_000,
            pulse_us: 5,
            is_forward_high: true,
            enabled: None,
        }
    }
}
