//! Plain pins: outputs, levels that are read in cycles, edges that interrupt.

use std::collections::BTreeMap;

use sensedsl_diagnostics::Diagnostic;
use sensedsl_files::{block, templates};
use sensedsl_job::{BoardJob, Cycle, JobConnection, JobDevice};
use sensedsl_model::kind::digital::{Digital, Edge, Pull};
use sensedsl_model::kind::{Kind, KindName, Role};
use sensedsl_wire::Direction;

use crate::context::{Context, level};
use crate::section::{Apply, Change, Cost, Section, Work};

/// An `up_digital_state_t` on AVR.
const STATE_BYTES: u32 = 17;

templates! {
    s: Levels;
    Tables = "digital.c.txt";
}

#[derive(Default)]
struct Levels {
    outputs: Vec<Output>,
    classes: Vec<Class>,
    awaited: Vec<Sensor>,
}

struct Output {
    ident: String,
    name: String,
    pins: Vec<Pin>,
    is_low_active: bool,
}

/// A pin with its place: `Relay at PD4 (GPIO)`
struct Pin {
    place: String,
    number: u8,
}

struct Class {
    ident: String,
    cycle: Cycle,
    sensors: Vec<Sensor>,
}

struct Sensor {
    ident: String,
    name: String,
    pins: Vec<Pin>,
    is_low_active: bool,
    debounce_us: u32,
    edge: Option<&'static str>,
    delay_ms: u32,
}

impl Sensor {
    /// Whether its wires keep a state.
    fn is_kept(&self) -> bool {
        self.edge.is_some() || self.debounce_us > 0
    }
}

pub(crate) fn lacks(_: &BoardJob<'_>, connection: &JobConnection<'_>) -> Option<&'static str> {
    let Kind::Digital(digital) = &connection.connection.kind else { return None };
    (digital.pull == Pull::Down).then_some("the pull-down resistors that an AVR lacks")
}

pub(crate) fn plan(context: &Context<'_>, _: &mut Vec<Diagnostic>) -> Section {
    let mut section = Section::default();
    for wire in context.job.connections(KindName::Digital) {
        let Kind::Digital(digital) = &wire.connection.kind else { continue };
        section.pads.extend(pad(context, wire, digital));
    }
    let mut levels = Levels::default();
    let mut classes: BTreeMap<Cycle, Vec<Sensor>> = BTreeMap::new();
    for (device, wires) in context.devices(KindName::Digital) {
        let Kind::Digital(digital) = &device.device.kind else { continue };
        let pins: Vec<Pin> = wires.iter().filter_map(|wire| pin(context, wire)).collect();
        if device.device.direction == Direction::Actuator {
            levels.output(device, digital, pins, &mut section);
            continue;
        }
        let sensor = Sensor::new(device, digital, pins);
        if sensor.edge.is_some() {
            awaited(&sensor, &wires, &mut section);
            levels.awaited.push(sensor);
        } else {
            classes.entry(device.cycle).or_default().push(sensor);
        }
    }
    let class = |(cycle, sensors): (Cycle, Vec<Sensor>)| Class {
        ident: cycle.ident("digital"),
        cycle,
        sensors,
    };
    levels.classes = classes.into_iter().map(class).collect();
    levels.add(&mut section);
    section
}

/// The line of C that sets a pad up. The level of an output is set before it becomes one.
fn pad(context: &Context<'_>, wire: &JobConnection<'_>, digital: &Digital) -> Option<String> {
    if let Some(number) = context.number(wire, Role::Out) {
        let level = if digital.initial == digital.active_low { "LOW" } else { "HIGH" };
        return Some(format!("digitalWrite({number}, {level});\n  pinMode({number}, OUTPUT);"));
    }
    let number = context.number(wire, Role::In)?;
    let mode = if digital.pull == Pull::Up { "INPUT_PULLUP" } else { "INPUT" };
    Some(format!("pinMode({number}, {mode});"))
}

fn pin(context: &Context<'_>, wire: &JobConnection<'_>) -> Option<Pin> {
    let number = context.number(wire, Role::In).or_else(|| context.number(wire, Role::Out))?;
    Some(Pin { place: wire.place(), number })
}

/// What runs when a wire of a sensor changes.
fn awaited(sensor: &Sensor, wires: &[&JobConnection<'_>], section: &mut Section) {
    for (index, wire) in wires.iter().enumerate() {
        let Some(pad) = wire.pad(Role::In) else { continue };
        let pin = pad.pin.name.clone();
        let ident = &sensor.ident;
        let line = format!("up_digital_on_change(&{ident}_digital, {index}U, {});", level(&pin));
        section.changes.push(Change { pin, line });
    }
}

impl Sensor {
    fn new(device: &JobDevice<'_>, digital: &Digital, pins: Vec<Pin>) -> Self {
        Self {
            ident: device.ident.clone(),
            name: device.name().to_owned(),
            pins,
            is_low_active: digital.active_low,
            debounce_us: digital.debounce_us,
            edge: digital.edge.map(|edge| match edge {
                Edge::Rising => "UP_EDGE_RISING",
                Edge::Falling => "UP_EDGE_FALLING",
                Edge::Both => "UP_EDGE_BOTH",
            }),
            delay_ms: device.device.delay_ms,
        }
    }
}

impl Levels {
    fn output(
        &mut self,
        device: &JobDevice<'_>,
        digital: &Digital,
        pins: Vec<Pin>,
        section: &mut Section,
    ) {
        let line = format!("up_digital_set(&{}_digital, value);", device.ident);
        section.applies.push(Apply { field: device.name().to_owned(), line });
        self.outputs.push(Output {
            ident: device.ident.clone(),
            name: device.name().to_owned(),
            pins,
            is_low_active: digital.active_low,
        });
    }

    /// Adds tables, work and the lines that look at contacts.
    fn add(&self, section: &mut Section) {
        for class in &self.classes {
            let kept = class.sensors.iter().enumerate().filter(|(_, one)| one.is_kept());
            for (index, _) in kept {
                let look = format!("up_digital_look(&{}_sensors[{index}]);", class.ident);
                section.starts.push(look.clone());
                section.polls.push(look);
            }
            section.work.push(class.work());
        }
        for one in &self.awaited {
            section.polls.push(format!("up_digital_poll(&{}_digital);", one.ident));
        }
        let all = self.classes.iter().flat_map(|class| &class.sensors).chain(&self.awaited);
        for one in all.filter(|one| one.is_kept()) {
            let bytes = STATE_BYTES * u32::try_from(one.pins.len()).unwrap_or(0) + 5;
            section.costs.push(Cost::new(format!("the contact {}", one.name), bytes, 0));
        }
        if !(self.outputs.is_empty() && self.classes.is_empty() && self.awaited.is_empty()) {
            section.headers.push("up_digital.h");
            section.costs.push(Cost::new("plain pins", 0, 1_250));
            section.tables = block(&Tables { s: self });
        }
    }
}

impl Class {
    fn work(&self) -> Work {
        Work {
            title: self.cycle.title("digital"),
            function: "up_digital_cycle",
            table: self.ident.clone(),
            cycle: self.cycle,
            field: self.sensors.first().map(|one| one.name.clone()).unwrap_or_default(),
        }
    }
}
