//! All versions: lines, their modes, and an interrupt for each line with edges.

use std::collections::BTreeMap;

use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::kind::digital::{Digital, Edge, Pull};
use sensedsl_model::kind::{Kind, KindName, Role};
use sensedsl_wire::Direction;

use crate::context::{Context, PadPlan};
use crate::names::Setting;
use crate::section::{Apply, Section, Work};
use crate::stacks::Depth;
use crate::timers;
use sensedsl_files::{block, templates};
use sensedsl_job::{Cycle, JobConnection, JobDevice};

/// The stack depth of its thread.
const DEPTH: Depth = Depth { plain: [224, 192], filtered: [416, 296] };

templates! {
    s: Levels;
    Tables = "digital/v1.c.txt";
}

#[derive(Default)]
struct Levels {
    outputs: Vec<Output>,
    /// The sensors that a thread reads, in classes.
    classes: Vec<Class>,
    /// The sensors with edges.
    awaited: Vec<Sensor>,
}

/// One actuator.
struct Output {
    ident: String,
    name: String,
    lines: Vec<Line>,
    is_low_active: bool,
}

/// A pin with its place: `Relay at PD12 (GPIO)`
struct Line {
    place: String,
    line: String,
}

/// Sensors of one cycle and priority: one thread.
struct Class {
    cycle: Cycle,
    ident: String,
    sensors: Vec<Sensor>,
}

struct Sensor {
    ident: String,
    name: String,
    id: u8,
    lines: Vec<Line>,
    is_low_active: bool,
    debounce_us: u32,
    edge: Option<&'static str>,
    delay_ms: u32,
    words: usize,
}

impl Sensor {
    /// Whether its wires keep a state.
    fn is_kept(&self) -> bool {
        self.edge.is_some() || self.debounce_us > 0
    }
}

pub(super) fn plan(context: &Context<'_>, diagnostics: &mut Vec<Diagnostic>) -> Section {
    let mut section = Section::default();
    for wired in context.connections(KindName::Digital) {
        let Kind::Digital(digital) = &wired.connection.kind else { continue };
        section.pads.extend(pad(context, wired, digital, diagnostics));
    }
    let mut levels = Levels::default();
    let mut classes: BTreeMap<Cycle, Vec<Sensor>> = BTreeMap::new();
    for (device, wires) in timers::devices(context, KindName::Digital) {
        let Kind::Digital(digital) = &device.device.kind else { continue };
        let lines = wires.iter().filter_map(|wired| line(context, wired)).collect();
        if device.device.direction == Direction::Actuator {
            levels.outputs.push(Output::new(device, digital, lines, &mut section));
            continue;
        }
        let sensor = Sensor::new(device, digital, lines);
        match sensor.edge {
            Some(_) => levels.awaited.push(sensor),
            None => classes.entry(device.cycle).or_default().push(sensor),
        }
    }
    let class = |(cycle, sensors): (Cycle, Vec<Sensor>)| Class {
        ident: cycle.ident("digital"),
        cycle,
        sensors,
    };
    levels.classes = classes.into_iter().map(class).collect();
    levels.lines(&mut section);
    let truth = if levels.awaited.is_empty() { "FALSE" } else { "TRUE" };
    section.hal =
        vec![Setting::new("PAL_USE_CALLBACKS", truth), Setting::new("PAL_USE_WAIT", "FALSE")];
    section.work = levels.classes.iter().map(Class::work).collect();
    let Levels { outputs, classes, awaited } = &levels;
    if !(outputs.is_empty() && classes.is_empty() && awaited.is_empty()) {
        section.tables = block(&Tables { s: &levels });
    }
    section
}

/// The pad of an output, whose level is set before it becomes one.
fn pad(
    context: &Context<'_>,
    wired: &JobConnection<'_>,
    digital: &Digital,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<PadPlan> {
    if let Some(pad) = wired.pad(Role::Out) {
        let plan = context.pad(pad, "PAL_MODE_OUTPUT_PUSHPULL", diagnostics)?;
        return Some(PadPlan { is_high: digital.initial != digital.active_low, ..plan });
    }
    let mode = match digital.pull {
        Pull::None => "PAL_MODE_INPUT",
        Pull::Up => "PAL_MODE_INPUT_PULLUP",
        Pull::Down => "PAL_MODE_INPUT_PULLDOWN",
    };
    context.pad(wired.pad(Role::In)?, mode, diagnostics)
}

fn line(context: &Context<'_>, wired: &JobConnection<'_>) -> Option<Line> {
    let pad = wired.pad(Role::In).or_else(|| wired.pad(Role::Out))?;
    Some(Line { place: wired.place(), line: context.line(&pad.pin.name)? })
}

impl Output {
    fn new(
        device: &JobDevice<'_>,
        digital: &Digital,
        lines: Vec<Line>,
        section: &mut Section,
    ) -> Self {
        let line = format!("up_digital_set(&{}_digital, value);", device.ident);
        section.applies.push(Apply { field: device.name().to_owned(), line });
        Self {
            ident: device.ident.clone(),
            name: device.name().to_owned(),
            lines,
            is_low_active: digital.active_low,
        }
    }
}

impl Sensor {
    fn new(device: &JobDevice<'_>, digital: &Digital, lines: Vec<Line>) -> Self {
        Self {
            ident: device.ident.clone(),
            name: device.name().to_owned(),
            id: device.device.id.value,
            lines,
            is_low_active: digital.active_low,
            debounce_us: digital.debounce_us,
            edge: digital.edge.map(|edge| match edge {
                Edge::Rising => "UP_EDGE_RISING",
                Edge::Falling => "UP_EDGE_FALLING",
                Edge::Both => "UP_EDGE_BOTH",
            }),
            delay_ms: device.device.delay_ms,
            words: timers::words(device),
        }
    }
}

impl Levels {
    /// Adds the lines that start and poll it.
    fn lines(&self, section: &mut Section) {
        for class in &self.classes {
            let kept = class.sensors.iter().enumerate().filter(|(_, one)| one.is_kept());
            for (index, _) in kept {
                let look = format!("up_digital_look(&{}_sensors[{index}]);", class.ident);
                section.starts.push(look.clone());
                section.polls.push(look);
            }
        }
        for one in &self.awaited {
            section.starts.push(format!("up_digital_start(&{}_digital);", one.ident));
            section.polls.push(format!("up_digital_poll(&{}_digital);", one.ident));
        }
    }
}

impl Class {
    /// The title, for a comment.
    fn title(&self) -> String {
        let names: Vec<&str> = self.sensors.iter().map(|one| one.name.as_str()).collect();
        format!("{}: {}", self.cycle.title("digital"), names.join(", "))
    }

    fn work(&self) -> Work {
        Work {
            unit: "digital".to_owned(),
            cycle: self.cycle,
            function: "up_digital_cycle",
            table: self.ident.clone(),
            device: self.sensors.first().map_or(0, |one| one.id),
            depth: DEPTH,
        }
    }
}
