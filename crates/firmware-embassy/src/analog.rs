//! Analog inputs: a task for each converter and cycle; one that has an array over several converters takes all of them.

use std::collections::BTreeSet;

use sensedsl_board::profile::Cycles;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::kind::{KindName, Role};
use sensedsl_timing::sampling;

use super::context::{Context, Wired, scalar};
use super::hal::Hal;
use super::item::{Handler, Item, Task};
use super::lack::{self, Printed};
use super::names::{AdcNew, AdcRead};
use super::section::{Field, Section, Start, Watched};
use super::{chip, filter, rp};
use sensedsl_job::snake;
use sensedsl_job::{Cycle, JobConnection};

pub(super) fn plan(context: &Context<'_>, diagnostics: &mut Vec<Diagnostic>) -> Section {
    let mut section = Section::default();
    let mut known = BTreeSet::new();
    for ((_, cycle), devices) in context.classes(KindName::Analog) {
        let Some(part) = devices.first().map(|one| one.first.part) else { continue };
        let made = class(context, cycle, &devices, &mut known, &mut section);
        context.tell(part, made, diagnostics);
    }
    section
}

/// The devices whose first elements are of one converter, and have one cycle.
fn class<'a>(
    context: &Context<'_>,
    cycle: Cycle,
    devices: &[Wired<'a>],
    known: &mut BTreeSet<&'a str>,
    section: &mut Section,
) -> Printed<()> {
    let converters = Converters::new(devices)?;
    for one in &converters.all {
        if known.insert(one) {
            unit(context, one, section)?;
        }
    }
    task(context, &converters, cycle, devices, section)
}

/// The converters of a task: one, or those that have elements of an array.
struct Converters<'a> {
    /// That of the first elements.
    first: &'a str,
    /// Every task takes them in this order, so that none waits for another that waits for it.
    all: BTreeSet<&'a str>,
}

impl<'a> Converters<'a> {
    fn new(devices: &[Wired<'a>]) -> Printed<Self> {
        let wires = devices.iter().flat_map(|one| &one.wires);
        let all: BTreeSet<&str> = wires.map(|wire| lack::unit(wire)).collect::<Printed<_>>()?;
        let first = devices.first().map(|one| lack::unit(one.first)).transpose()?;
        Ok(Self { first: first.unwrap_or_default(), all })
    }

    /// A converter that others use, too.
    fn shared(&self, unit: &str) -> String {
        if self.all.len() == 1 { "unit".to_owned() } else { format!("{}_unit", snake(unit)) }
    }

    /// The same when it is the task's own.
    fn own(&self, unit: &str) -> String {
        if self.all.len() == 1 { "adc".to_owned() } else { snake(unit) }
    }

    /// A line for each of them.
    fn lines(&self, line: impl Fn(&str) -> String) -> impl Iterator<Item = String> {
        self.all.iter().map(move |one| line(one))
    }
}

/// The converter, which tasks of several cycles share.
fn unit(context: &Context<'_>, unit: &str, section: &mut Section) -> Printed<()> {
    let (name, hal) = (snake(unit), context.peripheral(unit));
    let make = match context.names.adc.new {
        AdcNew::Unit => format!("hal::adc::Adc::new(p.{hal})"),
        AdcNew::Interrupt => {
            let interrupt = context.interrupt(unit, "GLOBAL")?;
            section.bind(interrupt, format!("hal::adc::InterruptHandler<{hal}>"));
            format!("hal::adc::Adc::new(p.{hal}, Irqs)")
        }
        AdcNew::Resolution => format!("hal::adc::Adc::new(p.{hal}, hal::adc::Resolution::BITS12)"),
        AdcNew::Default => format!("hal::adc::Adc::new(p.{hal}, hal::adc::AdcConfig::default())"),
        AdcNew::Config => {
            let interrupt = context.interrupt(unit, "GLOBAL")?;
            section.bind(interrupt, "hal::adc::InterruptHandler".to_owned());
            format!("hal::adc::Adc::new(p.{hal}, Irqs, hal::adc::Config::default())")
        }
    };
    let type_ = match context.names.hal {
        Hal::Stm32 => format!("hal::adc::Adc<'static, {hal}>"),
        Hal::Rp => "hal::adc::Adc<'static, hal::adc::Async>".to_owned(),
    };
    section.fields.push(Field {
        name: name.clone(),
        comment: format!("{unit}, which converts"),
        type_: type_.clone(),
        make,
    });
    if context.names.adc.read == AdcRead::Sampler {
        sampled(context, unit, section)?;
    }
    let declared = [
        format!("type {unit}Unit = Mutex<CriticalSectionRawMutex, {type_}>;"),
        format!("static {unit}_UNIT: StaticCell<{unit}Unit> = StaticCell::new();"),
    ];
    section.items.extend(declared.map(Item::Line));
    section.starts.push(Start::Make(format!(
        "let {name}: &'static {unit}Unit = {unit}_UNIT.init(Mutex::new(wiring.{name}));"
    )));
    Ok(())
}

fn task(
    context: &Context<'_>,
    converters: &Converters<'_>,
    cycle: Cycle,
    devices: &[Wired<'_>],
    section: &mut Section,
) -> Printed<()> {
    let ident = cycle.ident(converters.first);
    let constant = ident.to_uppercase();
    let wires: Vec<_> = devices.iter().flat_map(|one| &one.wires).collect();
    let units: Vec<&str> = converters.all.iter().copied().collect();
    let mut task = Task::in_turn(cycle.title(&units.join(" and ")), ident.clone(), cycle);
    let shared = |one: &str| format!("{}: &'static {one}Unit", converters.shared(one));
    task.parameters.extend(converters.lines(shared));
    let mutable = if context.names.adc.read == AdcRead::Sampler { "" } else { "mut " };
    for wire in &wires {
        let pin = &lack::pad(wire, Role::In)?.pin.name;
        let (type_, make) = match context.names.hal {
            Hal::Stm32 if context.names.adc.read == AdcRead::Sampler => {
                let hal = context.peripheral(lack::unit(wire)?);
                (
                    format!("hal::adc::AnyAdcChannel<'static, {hal}>"),
                    format!("hal::adc::AdcChannel::degrade_adc(p.{pin})"),
                )
            }
            Hal::Stm32 => (format!("Peri<'static, {pin}>"), format!("p.{pin}")),
            Hal::Rp => rp::analog::input(context, pin),
        };
        task.parameters.push(format!("{mutable}{}: {type_}", wire.ident));
        section.fields.push(Field { name: wire.ident.clone(), comment: wire.place(), type_, make });
    }
    let lock = |one: &str| {
        format!("let {mutable}{} = {}.lock().await;", converters.own(one), converters.shared(one))
    };
    let mut statements: Vec<String> = converters.lines(lock).collect();
    for device in devices {
        let pass = filter::pass(context, device.index, section, &mut task.before);
        statements.extend(read(context, converters, device, &pass, (&mut task.before, section))?);
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

/// All inputs one right after the other, as often as there are samples.
fn rows(
    converters: &Converters<'_>,
    wired: &Wired<'_>,
    call: &str,
    time: &str,
    wait: &str,
) -> Printed<Vec<String>> {
    let read = |(name, wire): (&String, &&JobConnection<'_>)| {
        let own = converters.own(lack::unit(wire)?);
        let ident = &wire.ident;
        Ok(format!("*{name} = {own}.{call}(&mut {ident}, hal::adc::SampleTime::{time}){wait};"))
    };
    let names = sample_names(wired);
    let reads = names.iter().zip(&wired.wires).map(read).collect::<Printed<Vec<String>>>()?;
    Ok(vec![each_sample(&names, &reads)])
}

/// A name for the sample of each input.
pub(super) fn sample_names(wired: &Wired<'_>) -> Vec<String> {
    (0..wired.wires.len()).map(|at| format!("s{at}")).collect()
}

/// The loop over the samples of all inputs.
pub(super) fn each_sample(names: &[String], reads: &[String]) -> String {
    format!("for [{}] in samples.as_chunks_mut().0 {{ {} }}", names.join(", "), reads.join(" "))
}

/// All samples of an input, then those of the next: the interrupt of the converter takes them.
fn columns(wired: &Wired<'_>, time: &str, slots: &str) -> Printed<Vec<String>> {
    let count = wired.wires.len();
    let fill = |(at, wire): (usize, &&JobConnection<'_>)| {
        let (unit, ident) = (lack::unit(wire)?, &wire.ident);
        Ok(format!(
            "{slots} = {}.fill({ident}.get_hw_channel(), hal::adc::SampleTime::{time}, {slots}, {at}, {count}).await;",
            sampler(unit)
        ))
    };
    wired.wires.iter().enumerate().map(fill).collect()
}

/// Room for the samples of a device, which its task and the interrupt hand to each other.
fn slots_of(slots: &str, samples: usize, section: &mut Section) -> String {
    let room = slots.to_uppercase();
    section.items.push(Item::Line(format!(
        "static {room}: StaticCell<[u16; {samples}]> = StaticCell::new();"
    )));
    format!("let mut {slots}: &'static mut [u16] = {room}.init([0; {samples}]);")
}

/// The static with the sampler of a converter.
fn sampler(unit: &str) -> String {
    format!("{unit}_SAMPLER")
}

/// What the interrupt of a converter does, which others may share.
fn sampled(context: &Context<'_>, unit: &str, section: &mut Section) -> Printed<()> {
    section.features.insert("adc-v2");
    let interrupt = context.interrupt(unit, "GLOBAL")?;
    let (name, sampler) = (format!("{unit}_SAMPLES"), sampler(unit));
    section.items.push(Item::Static {
        doc: format!("The samples of {unit}"),
        line: format!(
            "static {sampler}: rt::converter::Sampler = rt::converter::Sampler::new(hal::pac::{});",
            context.peripheral(unit)
        ),
    });
    section.bind(interrupt, format!("crate::{name}"));
    section.items.push(Item::Handler(Handler {
        doc: format!("The end of a conversion of {unit}"),
        name,
        named_as: "the converter",
        interrupt: interrupt.to_owned(),
        calls: vec![format!("{sampler}.on_interrupt();")],
    }));
    section.begins.push("// Its handler is there.".to_owned());
    section.begins.push(format!("unsafe {{ interrupt::{interrupt}.enable() }};"));
    Ok(())
}

/// Samples one device.
fn read(
    context: &Context<'_>,
    converters: &Converters<'_>,
    wired: &Wired<'_>,
    filter: &str,
    (before, section): (&mut Vec<String>, &mut Section),
) -> Printed<Vec<String>> {
    let analog = lack::kind(wired.first.connection.kind.analog())?;
    let count = wired.wires.len();
    let time = sampling(&context.profile.adc, analog.sampling_cycles);
    let time = time.unwrap_or(context.profile.adc.sample_cycles_default);
    let time = sample_time(time);
    let samples = usize::from(analog.samples.max(1)) * count;
    let slots = format!("{}_samples", wired.device.ident);
    let mut statements = Vec::new();
    let held = match context.names.adc.read {
        AdcRead::Sampler => {
            before.push(slots_of(&slots, samples, section));
            format!("&*{slots}")
        }
        AdcRead::Blocking | AdcRead::Async | AdcRead::Checked => {
            statements.push(format!("let mut samples = [0; {samples}];"));
            "&samples".to_owned()
        }
    };
    statements.extend(match context.names.adc.read {
        AdcRead::Blocking => rows(converters, wired, "blocking_read", &time, "")?,
        AdcRead::Async => rows(converters, wired, "read", &time, ".await")?,
        AdcRead::Sampler => columns(wired, &time, &slots)?,
        AdcRead::Checked => rp::analog::rows(wired),
    });
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
    let tell = format!(
        "rt::analog::report(&BOARD, {filter}, tables::{upper}, {}, &{how}, {held}, {count}, &mut [0; {}]);",
        scalar(value.scalar),
        value.size_bytes(),
    );
    statements.push(match context.names.adc.read {
        AdcRead::Blocking | AdcRead::Async | AdcRead::Sampler => tell,
        AdcRead::Checked => rp::analog::tell(&upper, &tell),
    });
    Ok(statements)
}

/// `CYCLES84`, `CYCLES1_5`
fn sample_time(cycles: Cycles) -> String {
    let half = if cycles.halves() % 2 == 1 { "_5" } else { "" };
    format!("CYCLES{}{half}", cycles.whole())
}
