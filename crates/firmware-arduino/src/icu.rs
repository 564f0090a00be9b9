//! Pulses: by the capture input of a timer, or by the interrupt of a pin.

use sensedsl_diagnostics::Diagnostic;
use sensedsl_files::{block, templates};
use sensedsl_job::kinds::pulse;
use sensedsl_job::{BoardJob, Cycle, JobConnection, JobDevice};
use sensedsl_model::kind::icu::{Edge, Icu, Mode};
use sensedsl_model::kind::{KindName, Role};

use crate::context::{Context, level};
use crate::section::{Change, Cost, Section, Work};

/// The time without an edge after which a frequency is 0.
const SILENT_MS: u32 = 1_000;
/// The framework's clock counts microseconds, in steps of four.
const FRAMEWORK_HZ: u32 = 1_000_000;
/// What divides the clock of a capturing timer.
const DIVIDER: u32 = 8;
/// An `up_edges_t`, an `up_capture_state_t` and, in an array, a flag and a value.
const INPUT_BYTES: u32 = 25 + 10;

templates! {
    s: Captures;
    Tables = "icu.c.txt";
}

struct Captures {
    captures: Vec<Capture>,
    sensors: Vec<Sensor>,
    pulses: Vec<Pulse>,
}

/// A capturing timer.
struct Capture {
    place: String,
    /// The number of the timer.
    timer: String,
    edges: String,
    /// Whether the first edge of a pulse is the rising one.
    is_active_high: bool,
    counts_both_edges: bool,
}

/// An `up_icu_t`.
struct Sensor {
    ident: String,
    name: String,
    places: Vec<String>,
    mode: &'static str,
    tick_hz: u32,
    silent_ms: u32,
    clock_hz: u32,
    counts_both_edges: bool,
    is_complete: bool,
    element_bytes: usize,
}

/// Wires that get a pulse in the same cycle.
struct Pulse {
    ident: String,
    cycle: Cycle,
    pulse_us: u32,
    field: String,
    lines: Vec<Line>,
}

struct Line {
    place: String,
    number: u8,
    apart_ms: u32,
}

impl Sensor {
    fn is_array(&self) -> bool {
        self.places.len() > 1
    }
}

pub(crate) fn lacks(_: &BoardJob<'_>, connection: &JobConnection<'_>) -> Option<&'static str> {
    let icu = connection.connection.kind.icu()?;
    (icu.mode == Mode::Ppm).then_some("the pulse trains of model receivers")
}

pub(crate) fn plan(context: &Context<'_>, _: &mut Vec<Diagnostic>) -> Section {
    let mut section = Section::default();
    let mut all = Captures { captures: Vec::new(), sensors: Vec::new(), pulses: Vec::new() };
    for (device, wires) in context.devices(KindName::Icu) {
        all.sensor(context, device, &wires, &mut section);
    }
    all.pulses = pulses(context, &mut section);
    section.polls =
        all.sensors.iter().map(|one| format!("up_icu_poll(&{}_icu);", one.ident)).collect();
    if !(all.sensors.is_empty() && all.pulses.is_empty()) {
        section.headers.push("up_icu.h");
        section.costs.push(Cost::new("pulses", 0, 2_000));
        section.tables = block(&Tables { s: &all });
    }
    section
}

impl Captures {
    fn sensor(
        &mut self,
        context: &Context<'_>,
        device: &JobDevice<'_>,
        wires: &[&JobConnection<'_>],
        section: &mut Section,
    ) {
        let Some(icu) = device.device.kind.icu() else { return };
        let mut is_captured = false;
        for (index, wire) in wires.iter().enumerate() {
            let edges = format!("{}_edges[{index}]", device.ident);
            is_captured = self.input(context, icu, wire, edges, section);
        }
        let elements = u32::try_from(wires.len()).unwrap_or(0);
        let bytes = elements * INPUT_BYTES;
        section.costs.push(Cost::new(format!("the edges of {}", device.name()), bytes, 0));
        let clock_hz = if is_captured { context.cpu_hz / DIVIDER } else { FRAMEWORK_HZ };
        self.sensors.push(Sensor {
            ident: device.ident.clone(),
            name: device.name().to_owned(),
            places: wires.iter().map(|wire| place(wire, clock_hz, is_captured)).collect(),
            mode: mode(icu.mode),
            tick_hz: icu.tick_hz,
            silent_ms: SILENT_MS,
            clock_hz,
            counts_both_edges: counts_both(icu),
            is_complete: matches!(icu.mode, Mode::Width | Mode::Period),
            element_bytes: device.device.value.value.scalar.size_bytes(),
        });
    }

    /// One wire; tells whether a timer captures it.
    fn input(
        &mut self,
        context: &Context<'_>,
        icu: &Icu,
        wire: &JobConnection<'_>,
        edges: String,
        section: &mut Section,
    ) -> bool {
        let Some(pad) = wire.pad(Role::In) else { return false };
        let is_active_high = icu.edge != Edge::Falling;
        // Pins are inputs from the start.
        let timer = context.channel(pad).map(|(timer, _)| timer.name.as_str());
        let timer = timer.filter(|name| context.names.capture_timers.iter().any(|one| one == name));
        if let Some(timer) = timer {
            let number = timer.trim_start_matches(|c: char| !c.is_ascii_digit()).to_owned();
            section.starts.push(format!("start_capture_{number}();"));
            let (place, counts_both_edges) = (wire.place(), counts_both(icu));
            self.captures.push(Capture {
                place,
                timer: number,
                edges,
                is_active_high,
                counts_both_edges,
            });
            return true;
        }
        let pin = pad.pin.name.clone();
        let active = if is_active_high { level(&pin) } else { format!("!({})", level(&pin)) };
        let both = counts_both(icu);
        let line = format!("up_edges_on_change(&{edges}, {active}, UP_EDGE_US(), {both});");
        section.changes.push(Change { pin, line });
        false
    }
}

/// The place of a wire, and how exact the times of its edges are.
fn place(wire: &JobConnection<'_>, clock_hz: u32, is_captured: bool) -> String {
    if is_captured {
        let ns = 1_000_000_000 / clock_hz.max(1);
        format!("{}: captured, in steps of {ns} ns", wire.place())
    } else {
        format!("{}: by its interrupt, in steps of 4 us", wire.place())
    }
}

fn counts_both(icu: &Icu) -> bool {
    icu.mode == Mode::Count && icu.edge == Edge::Both
}

fn mode(mode: Mode) -> &'static str {
    match mode {
        Mode::Count | Mode::Ppm => "UP_CAPTURE_COUNT",
        Mode::Width => "UP_CAPTURE_WIDTH",
        Mode::Period => "UP_CAPTURE_PERIOD",
        Mode::Frequency => "UP_CAPTURE_FREQUENCY",
        Mode::Duty => "UP_CAPTURE_DUTY",
    }
}

fn pulses(context: &Context<'_>, section: &mut Section) -> Vec<Pulse> {
    let all = pulse::pulses(context.job);
    let mut made = Vec::new();
    for one in &all {
        let several = all.iter().filter(|other| other.cycle == one.cycle).count() > 1;
        let mut ident = one.cycle.ident("pulse");
        if several {
            ident.push_str(&format!("_{}us", one.pulse_us));
        }
        let lines = one.lines.iter().filter_map(|line| {
            let number = context.number(line.wire, Role::Trigger)?;
            section
                .pads
                .push(format!("digitalWrite({number}, LOW);\n  pinMode({number}, OUTPUT);"));
            Some(Line { place: line.wire.place(), number, apart_ms: line.apart_ms })
        });
        let lines = lines.collect();
        let device = context.job.devices.iter().find(|device| device.device.id.value == one.id);
        let field = device.map(|device| device.name().to_owned()).unwrap_or_default();
        made.push(Pulse { ident, cycle: one.cycle, pulse_us: one.pulse_us, field, lines });
    }
    section.work.extend(made.iter().map(|one| Work {
        title: one.cycle.title("pulse"),
        function: "up_pulse_cycle",
        table: one.ident.clone(),
        cycle: one.cycle,
        field: one.field.clone(),
    }));
    made
}
