//! Analog inputs: a task for each converter and cycle. A task with an array over several converters has all of them.

use std::collections::BTreeSet;

use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::kind::{KindName, Role};
use sensedsl_timing::sampling;

use super::context::{Context, Wired, scalar};
use super::hal::contract::Drivers;
use super::hal::contract::inputs::{Analog, AnalogInput, SampleRoom};
use super::item::{Item, Task};
use super::missing::{self, Printed};
use super::section::{Field, Section, Start, Watched};
use super::{chip, filter};
use sensedsl_job::Cycle;
use sensedsl_job::snake;

pub(super) fn plan(
    context: &Context<'_>,
    drivers: &dyn Drivers,
    diagnostics: &mut Vec<Diagnostic>,
) -> Section {
    let mut section = Section::default();
    let Some(analog) = drivers.analog() else { return section };
    let mut known = BTreeSet::new();
    for ((_, cycle), devices) in context.classes(KindName::Analog) {
        let Some(part) = devices.first().map(|one| one.first.part) else { continue };
        let made = class(context, analog, (cycle, &devices), &mut known, &mut section);
        context.report(part, made, diagnostics);
    }
    section
}

/// The devices of one cycle whose first elements have the same converter.
fn class<'a>(
    context: &Context<'_>,
    analog: &dyn Analog,
    (cycle, devices): (Cycle, &[Wired<'a>]),
    known: &mut BTreeSet<&'a str>,
    section: &mut Section,
) -> Printed<()> {
    let converters = Converters::new(devices)?;
    for one in &converters.all {
        if known.insert(one) {
            unit(context, analog, one, section)?;
        }
    }
    task(context, analog, &converters, (cycle, devices), section)
}

/// The converters of a task: one, or those that the elements of an array have.
struct Converters<'a> {
    /// The converter of the first elements.
    first: &'a str,
    /// All of them. Every task locks them in this order, so that no two wait for each other.
    all: BTreeSet<&'a str>,
}

impl<'a> Converters<'a> {
    fn new(devices: &[Wired<'a>]) -> Printed<Self> {
        let wires = devices.iter().flat_map(|one| &one.wires);
        let all: BTreeSet<&str> = wires.map(|wire| missing::unit(wire)).collect::<Printed<_>>()?;
        let first = devices.first().map(|one| missing::unit(one.first)).transpose()?;
        Ok(Self { first: first.unwrap_or_default(), all })
    }

    /// The parameter that has a converter, which other tasks use as well.
    fn shared(&self, unit: &str) -> String {
        if self.all.len() == 1 { "unit".to_owned() } else { format!("{}_unit", snake(unit)) }
    }

    /// The variable that has a converter while the task has locked it.
    fn own(&self, unit: &str) -> String {
        if self.all.len() == 1 { "adc".to_owned() } else { snake(unit) }
    }

    /// A line for each of them.
    fn lines(&self, line: impl Fn(&str) -> String) -> impl Iterator<Item = String> {
        self.all.iter().map(move |one| line(one))
    }
}

/// The converter, which the tasks of several cycles share.
fn unit(
    context: &Context<'_>,
    analog: &dyn Analog,
    unit: &str,
    section: &mut Section,
) -> Printed<()> {
    let name = snake(unit);
    let made = analog.converter(context, unit, section)?;
    let declared = [
        format!("type {unit}Unit = Mutex<CriticalSectionRawMutex, {}>;", made.type_),
        format!("static {unit}_UNIT: StaticCell<{unit}Unit> = StaticCell::new();"),
    ];
    section.items.extend(declared.map(Item::Line));
    section.starts.push(Start::Make(format!(
        "let {name}: &'static {unit}Unit = {unit}_UNIT.init(Mutex::new(wiring.{name}));"
    )));
    section.fields.push(Field::of(name, format!("{unit}, which converts"), made));
    Ok(())
}

/// The task that reads the devices of one cycle.
fn task(
    context: &Context<'_>,
    analog: &dyn Analog,
    converters: &Converters<'_>,
    (cycle, devices): (Cycle, &[Wired<'_>]),
    section: &mut Section,
) -> Printed<()> {
    let ident = cycle.ident(converters.first);
    let constant = ident.to_uppercase();
    let wires: Vec<_> = devices.iter().flat_map(|one| &one.wires).collect();
    let units: Vec<&str> = converters.all.iter().copied().collect();
    let mut task = Task::in_turn(cycle.title(&units.join(" and ")), ident.clone(), cycle);
    let shared = |one: &str| format!("{}: &'static {one}Unit", converters.shared(one));
    task.parameters.extend(converters.lines(shared));
    let mutable = match analog.room() {
        SampleRoom::Task => "mut ",
        SampleRoom::Interrupt => "",
    };
    for wire in &wires {
        let pin = &missing::pad(wire, Role::In)?.pin.name;
        let made = analog.input(context, missing::unit(wire)?, pin);
        task.parameters.push(format!("{mutable}{}: {}", wire.ident, made.type_));
        section.fields.push(Field::of(wire.ident.clone(), wire.place(), made));
    }
    let lock = |one: &str| {
        format!("let {mutable}{} = {}.lock().await;", converters.own(one), converters.shared(one))
    };
    let mut statements: Vec<String> = converters.lines(lock).collect();
    for device in devices {
        let pass = filter::pass(context, device.index, section, &mut task.before);
        let samples = sample(context, analog, converters, device, section)?;
        task.before.extend(samples.room);
        statements.extend(samples.statements);
        statements.push(report(context, analog, device, &pass, &samples.filled));
    }
    statements.extend(converters.lines(|one| format!("drop({});", converters.own(one))));
    task.ticks(cycle.delay_ms, statements, &constant);
    section.items.push(Item::Task(task));
    let units = units.into_iter().map(snake);
    let arguments: Vec<String> =
        units.chain(wires.iter().map(|wire| format!("wiring.{}", wire.ident))).collect();
    let call = format!("{ident}({})", arguments.join(", "));
    section.starts.push(Start::Task(cycle.prio, call));
    let device = wires.first().map_or(0, |wire| context.id_of(wire));
    section.watched.push(Watched::new(constant, cycle, device));
    Ok(())
}

/// How one device is sampled.
struct Samples {
    /// The statement before the task's loop that makes room for them.
    room: Option<String>,
    /// The statements that sample all inputs.
    statements: Vec<String>,
    /// The samples, as a slice.
    filled: String,
}

fn sample(
    context: &Context<'_>,
    analog: &dyn Analog,
    converters: &Converters<'_>,
    wired: &Wired<'_>,
    section: &mut Section,
) -> Printed<Samples> {
    let own = missing::kind(wired.first.connection.kind.analog())?;
    let samples = usize::from(own.samples.max(1)) * wired.wires.len();
    let inputs = wired.wires.iter().copied().map(|wire| {
        let unit = missing::unit(wire)?;
        Ok(AnalogInput { wire, unit, converter: converters.own(unit) })
    });
    let inputs = inputs.collect::<Printed<Vec<_>>>()?;
    let adc = &context.profile.adc;
    let sampling = sampling(adc, own.sampling_cycles).unwrap_or(adc.sample_cycles_default);
    Ok(match analog.room() {
        SampleRoom::Task => {
            let mut statements = vec![format!("let mut samples = [0; {samples}];")];
            statements.extend(analog.sample(&inputs, sampling, "samples"));
            Samples { room: None, statements, filled: "&samples".to_owned() }
        }
        SampleRoom::Interrupt => {
            let name = format!("{}_samples", wired.device.ident);
            let room = name.to_uppercase();
            section.items.push(Item::Line(format!(
                "static {room}: StaticCell<[u16; {samples}]> = StaticCell::new();"
            )));
            let make = format!("let mut {name}: &'static mut [u16] = {room}.init([0; {samples}]);");
            let statements = analog.sample(&inputs, sampling, &name);
            Samples { room: Some(make), statements, filled: format!("&*{name}") }
        }
    })
}

/// The statement that reports the value of one device, computed from its samples.
fn report(
    context: &Context<'_>,
    analog: &dyn Analog,
    wired: &Wired<'_>,
    filter: &str,
    samples: &str,
) -> String {
    let value = wired.device.device.value.value;
    let upper = wired.device.ident.to_uppercase();
    let mut formulas = context.job.tables_of(wired.first).into_iter().flat_map(|one| &one.formulas);
    let formula = formulas.find(|plan| plan.field == wired.device.name());
    let how = match formula {
        Some(plan) => {
            let parameters: Vec<String> = plan.parameters.iter().map(ToString::to_string).collect();
            format!(
                "rt::analog::Value::Computed(&{}, {}, &[{}])",
                chip::formula(plan.formula),
                plan.output,
                parameters.join(", ")
            )
        }
        None => "rt::analog::Value::Mean".to_owned(),
    };
    let report = format!(
        "rt::analog::report(&BOARD, {filter}, tables::{upper}, {}, &{how}, {samples}, {}, &mut [0; {}]);",
        scalar(value.scalar),
        wired.wires.len(),
        value.size_bytes(),
    );
    analog.report(&upper, report)
}
