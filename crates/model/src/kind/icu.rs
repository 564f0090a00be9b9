//! `icu`: edges on an input-capture channel; the hardware measures and callbacks collect the
//! results.

use sensedsl_board::signal::Function;
use sensedsl_syntax::Unit;
use sensedsl_wire::{Direction, ScalarType, ValueType};

use super::role::Role;
use super::spec::{KindSpec, Properties, Serves, Sharing, Values};
use crate::fields::Fields;
use crate::meaning::{Meaning, Takes, first};

/// The properties that all devices of this kind share.
pub const SPEC: KindSpec = KindSpec {
    name: "icu",
    article: "an",
    directions: &[Direction::Sensor],
    values: Values::OneNumber,
    properties: &["mode", "edge", "resolution", "pulse", "wait", "pin", "trigger"],
    sharing: Sharing::Own,
    triggers_itself: true,
    codes: None,
    natural: ScalarType::Uint16,
    inputs_have: &[],
    of_part: &[],
    serves: Serves::Signal(serves),
    wires: "one input-capture channel (CH1 or CH2; B of an RP2 slice, ICP of an AVR timer); the whole timer is taken. With Embassy on RP2 a state machine at any pin. With `pulse` also a GPIO",
    example: "",
    colour: "#80B67A",
    colour_on_dark: "#9A9655",
    letter: 'C',
};

/// What its properties mean, besides those that fix wires.
pub(crate) const MEANINGS: &[Meaning] = &[
    Meaning::new(
        ("mode", Takes::Words(|| Mode::ALL.map(Mode::name).to_vec())),
        "`count`",
        "`count`: edges since the start; `width` and `period`: last pulse and last period in ticks; \
         `frequency`: active edges per second; `duty`: active part in ten-thousandths; `ppm`: the channels of \
         a model receiver in us, of a driver's reading only.",
        "mode = width;",
    ),
    Meaning::new(
        ("edge", Takes::Words(|| first(&EDGES))),
        "`rising`",
        "Which edge begins a pulse, or is counted; `both` is for counting only.",
        "edge = falling;",
    ),
    Meaning::new(
        ("resolution", Takes::Rate(1, 100_000_000)),
        "10 kHz to count, 1 us to measure",
        "The tick of the timer. The clock must divide to it within a thousandth.",
        "resolution = 1 us;",
    ),
    Meaning::new(
        ("pulse", Takes::Time(1, 10_000)),
        "none",
        "Each cycle a pulse of that length goes out on the wire `trigger` (HC-SR04).",
        "pulse = 10 us;",
    ),
    Meaning::new(
        ("wait", Takes::Time(0, 60_000_000)),
        "0",
        "With `pulse`: how long the device measures after it.",
        "wait = 60 ms;",
    ),
];

/// What is computed from the edges.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Mode {
    /// Number of edges since the start; wraps around.
    #[default]
    Count,
    /// Length of the active pulse, in ticks of the resolution.
    Width,
    /// Time from one active edge to the next, in ticks of the resolution.
    Period,
    /// Active edges per second.
    Frequency,
    /// Active part of a period, in ten-thousandths.
    Duty,
    /// The channels of a radio-control receiver, one after the other on one wire, in microseconds.
    Ppm,
}

impl Mode {
    /// All variants.
    pub const ALL: [Self; 6] =
        [Self::Count, Self::Width, Self::Period, Self::Frequency, Self::Duty, Self::Ppm];

    /// The word in the language.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Count => "count",
            Self::Width => "width",
            Self::Period => "period",
            Self::Frequency => "frequency",
            Self::Duty => "duty",
            Self::Ppm => "ppm",
        }
    }
}

/// Which edge begins a pulse.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Edge {
    /// From low to high.
    #[default]
    Rising,
    /// From high to low.
    Falling,
    /// Every change; only for counting.
    Both,
}

/// The words after `edge`.
const EDGES: [(&str, Edge); 3] =
    [("rising", Edge::Rising), ("falling", Edge::Falling), ("both", Edge::Both)];

/// An input-capture channel.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Icu {
    /// What is computed from the edges.
    pub mode: Mode,
    /// The edge that begins a pulse.
    pub edge: Edge,
    /// Ticks per second of the measuring timer.
    pub tick_hz: u32,
    /// Where the resolution is given.
    pub tick_span: Option<sensedsl_diagnostics::Span>,
    /// Length of the pulse on the role `trigger` that makes the device measure.
    pub pulse_us: Option<u32>,
    /// The duration of the measurement after that pulse.
    pub wait_us: u32,
}

/// Ticks per second if the file gives none. Counting does not need a particular value, so it gets
/// that of the car's firmware; measuring gets microseconds.
const fn tick_default_hz(mode: Mode) -> u32 {
    match mode {
        Mode::Count => 10_000,
        Mode::Width | Mode::Period | Mode::Frequency | Mode::Duty | Mode::Ppm => 1_000_000,
    }
}

fn serves(_: Role, function: &Function) -> bool {
    let is_input = matches!(function, Function::Timer { line, .. } if line.is_input());
    is_input || matches!(function, Function::Pio { .. })
}

impl Properties for Icu {
    fn read(fields: &mut Fields<'_>, _: Direction, _: ValueType) -> Self {
        let mode = mode(fields);
        let edge = fields.word("edge", &EDGES);
        if let Some(edge) = edge
            && edge.value == Edge::Both
            && mode != Mode::Count
        {
            fields.contradiction(edge.span, "mode", "`edge = both` is for counting only");
        }
        let tick = fields.rate_hz("resolution", 1..=100_000_000, Unit::Hertz);
        let pulse = fields.time_us("pulse", 1..=10_000);
        let wait = fields.time_us("wait", 0..=60_000_000);
        if let (Some(wait), None) = (wait, pulse) {
            fields.contradiction(wait.span, "type", "`wait` is for a device with a `pulse` only");
        }
        Self {
            mode,
            edge: edge.map(|word| word.value).unwrap_or_default(),
            tick_hz: tick.map_or(tick_default_hz(mode), |tick| tick.value),
            tick_span: tick.map(|tick| tick.span),
            pulse_us: pulse.map(|pulse| pulse.value),
            wait_us: wait.map_or(0, |wait| wait.value),
        }
    }

    fn plain(_: u8) -> Self {
        Self::default()
    }

    fn roles(&self, _: Direction) -> Vec<Role> {
        if self.pulse_us.is_some() { vec![Role::In, Role::Trigger] } else { vec![Role::In] }
    }

    fn measuring_us(&self) -> u32 {
        self.wait_us
    }
}

fn mode(fields: &mut Fields<'_>) -> Mode {
    let modes = Mode::ALL.map(|mode| (mode.name(), mode));
    let Some(mode) = fields.word("mode", &modes) else { return Mode::default() };
    // Its value is several numbers on one wire, which only a driver's reading can declare.
    if mode.value == Mode::Ppm && !fields.is_of_reading() {
        let why = "`mode = ppm` is for a driver that says how many channels there are: \
                   `driver = ppm;`";
        fields.contradiction(mode.span, "type", why);
        return Mode::default();
    }
    mode.value
}

impl Default for Icu {
    fn default() -> Self {
        let mode = Mode::default();
        let tick_hz = tick_default_hz(mode);
        Self { mode, edge: Edge::default(), tick_hz, tick_span: None, pulse_us: None, wait_us: 0 }
    }
}
