//! `TIMv1`: a driver object for each captured wire, served by callbacks.

use sensedsl_board::signal::UnitName;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::kind::icu::{Edge, Icu, Mode};
use sensedsl_model::kind::{KindName, Role};
use sensedsl_timing::Tick;

use crate::context::{Context, Drive};
use crate::names::Setting;
use crate::section::Section;
use crate::timers::{self, Channel};
use sensedsl_files::{block, templates};
use sensedsl_job::{JobConnection, JobDevice};

/// The time without an edge after which a frequency is 0.
const SILENT_MS: u32 = 1_000;

templates! {
    s: Captures;
    Tables = "icu/v1.c.txt";
}

struct Captures {
    inputs: Vec<Input>,
    sensors: Vec<Sensor>,
}

/// One captured wire.
struct Input {
    ident: String,
    /// `Wheel at PB4 (TIM3_CH1)`
    place: String,
    /// The measurement, for a comment.
    what: String,
    driver: String,
    channel: u8,
    level: &'static str,
    tick_hz: u32,
    counts_both_edges: bool,
    has_width: bool,
    has_period: bool,
    /// True if wraps of the timer are reported, so that spoilt measurements are left out.
    has_overflow: bool,
    /// The table of the receiver's pulse train.
    train: Option<String>,
}

/// One sensor.
struct Sensor {
    ident: String,
    name: String,
    /// Its wires.
    inputs: Vec<String>,
    drivers: Vec<String>,
    mode: &'static str,
    tick_hz: u32,
    silent_ms: u32,
    counts_both_edges: bool,
    /// True for an array whose elements must all have been measured again.
    is_complete: bool,
    words: usize,
    train: Option<String>,
}

impl Sensor {
    fn is_array(&self) -> bool {
        self.train.is_none() && self.inputs.len() > 1
    }
}

pub(super) fn plan(context: &Context<'_>, diagnostics: &mut Vec<Diagnostic>) -> Section {
    let mut section = Section::default();
    let mut captures = Captures { inputs: Vec::new(), sensors: Vec::new() };
    for wired in context.connections(KindName::Icu) {
        let Some(pad) = wired.pad(Role::In) else { continue };
        section.pads.extend(context.alternate_pad(pad, Drive::Plain, diagnostics));
        let Some(channel) = timers::channel(context, pad) else { continue };
        let Some(input) = Input::new(context, wired, &channel) else { continue };
        section.units.insert(UnitName::new(&channel.timer.name));
        section.clocks.insert(channel.timer.clock.clone());
        section.guards.push(timers::divides(channel.timer, input.tick_hz));
        section.guards.push(timers::has_channels(channel.timer, 2));
        let start = format!("up_icu_start(&{}, &{}_icu_config);", input.driver, input.ident);
        section.starts.push(start);
        captures.inputs.push(input);
    }
    for (device, wires) in timers::devices(context, KindName::Icu) {
        captures.sensors.extend(Sensor::new(device, &wires, &captures.inputs));
    }
    let truth = if captures.inputs.is_empty() { "FALSE" } else { "TRUE" };
    section.switch = Some(Setting::new("HAL_USE_ICU", truth));
    section.hal = vec![Setting::new("ICU_USE_OVERFLOW_SCALING", "FALSE")];
    let poll = |one: &Sensor| match one.train {
        Some(_) => format!("up_train_poll(&{}_train);", one.ident),
        None => format!("up_icu_poll(&{}_icu);", one.ident),
    };
    section.polls = captures.sensors.iter().map(poll).collect();
    if !captures.inputs.is_empty() {
        section.tables = block(&Tables { s: &captures });
    }
    section
}

impl Input {
    fn new(
        context: &Context<'_>,
        wired: &JobConnection<'_>,
        channel: &Channel<'_>,
    ) -> Option<Self> {
        let own: Vec<(&JobDevice<'_>, &Icu)> = context
            .devices_of(wired)
            .filter_map(|one| Some((one, one.device.kind.icu()?)))
            .collect();
        let icu = own.first().map(|(_, icu)| *icu).or_else(|| wired.connection.kind.icu())?;
        let any = |is_wanted: fn(Mode) -> bool| own.iter().any(|(_, icu)| is_wanted(icu.mode));
        let train = own.iter().find(|(_, icu)| icu.mode == Mode::Ppm);
        let counts_both_edges = icu.mode == Mode::Count && icu.edge == Edge::Both;
        channel.timer.icu.as_ref()?;
        let clock_hz = context.chibios.clocks_hz.get(&channel.timer.clock).copied();
        let made = clock_hz.and_then(|clock_hz| Tick { clock_hz, tick_hz: icu.tick_hz }.made());
        let tick_hz = made.unwrap_or(icu.tick_hz);
        Some(Self {
            ident: wired.ident.clone(),
            place: wired.place(),
            what: what(icu) + &off(icu.tick_hz, tick_hz),
            driver: context.names.driver(&channel.timer.name)?,
            channel: channel.number,
            level: match icu.edge {
                Edge::Rising | Edge::Both => "ICU_INPUT_ACTIVE_HIGH",
                Edge::Falling => "ICU_INPUT_ACTIVE_LOW",
            },
            tick_hz,
            counts_both_edges,
            has_width: counts_both_edges || any(|mode| matches!(mode, Mode::Width | Mode::Duty)),
            has_period: any(|mode| mode != Mode::Width),
            // A counter has none: with it, the driver would not report the edge after a wrap.
            has_overflow: any(|mode| mode != Mode::Count),
            train: train.map(|(device, _)| device.ident.clone()),
        })
    }
}

/// The actual ticks, for a comment, if the clock does not divide to the requested ones.
fn off(asked_hz: u32, made_hz: u32) -> String {
    if asked_hz == made_hz {
        return String::new();
    }
    let ppm = u64::from(asked_hz.abs_diff(made_hz)) * 1_000_000 / u64::from(asked_hz.max(1));
    let direction = if made_hz < asked_hz { "less" } else { "more" };
    format!("; {made_hz} ticks a second, {ppm} ppm {direction} than {asked_hz}")
}

/// The measurement, for a comment.
fn what(icu: &Icu) -> String {
    let edges = match icu.edge {
        Edge::Rising => "rising",
        Edge::Falling => "falling",
        Edge::Both => "both",
    };
    match icu.mode {
        Mode::Count => format!("{edges} edges are counted"),
        Mode::Width if icu.edge == Edge::Falling => "the width of low pulses".to_owned(),
        Mode::Width => "the width of high pulses".to_owned(),
        Mode::Period => format!("the time between {edges} edges"),
        Mode::Frequency => format!("{edges} edges a second"),
        Mode::Duty if icu.edge == Edge::Falling => "the low part of a period".to_owned(),
        Mode::Duty => "the high part of a period".to_owned(),
        Mode::Ppm => "a train of pulses, one a channel".to_owned(),
    }
}

impl Sensor {
    fn new(device: &JobDevice<'_>, wires: &[&JobConnection<'_>], inputs: &[Input]) -> Option<Self> {
        let icu = device.device.kind.icu()?;
        let own = wires.iter().filter_map(|wire| inputs.iter().find(|one| one.ident == wire.ident));
        let own: Vec<&Input> = own.collect();
        let first = own.first()?;
        let mode = match icu.mode {
            Mode::Count => "UP_CAPTURE_COUNT",
            Mode::Width => "UP_CAPTURE_WIDTH",
            Mode::Period => "UP_CAPTURE_PERIOD",
            Mode::Frequency => "UP_CAPTURE_FREQUENCY",
            Mode::Duty => "UP_CAPTURE_DUTY",
            Mode::Ppm => "",
        };
        Some(Self {
            ident: device.ident.clone(),
            name: device.name().to_owned(),
            inputs: own.iter().map(|one| one.ident.clone()).collect(),
            drivers: own.iter().map(|one| one.driver.clone()).collect(),
            mode,
            tick_hz: first.tick_hz,
            silent_ms: SILENT_MS,
            counts_both_edges: first.counts_both_edges,
            is_complete: matches!(icu.mode, Mode::Width | Mode::Period),
            words: timers::words(device),
            train: first.train.clone().filter(|_| icu.mode == Mode::Ppm),
        })
    }
}
