//! Analog inputs: a task for each converter and cycle; one that has an array over several converters takes all of them.

use std::collections::BTreeSet;

use sensedsl_board::profile::Cycles;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::kind::{KindName, Role};
use sensedsl_timing::sampling;

use super::context::{Context, Wired, late, scalar};
use super::hal::Hal;
use super::lack::{self, Printed};
use super::names::{AdcNew, AdcRead};
use super::section::{Field, Section, Start, Watched};
use super::{chip, filter, rp};
use sensedsl_job::Cycle;
use sensedsl_job::snake;

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
    fn lines(&self, line: impl Fn(&str) -> String) -> String {
        self.all.iter().map(|one| line(one)).collect()
    }
}

/// The converter, which tasks of several cycles share.
fn unit(context: &Context<'_>, unit: &str, section: &mut Section) -> Printed<()> {
    let (name, hal) = (snake(unit), context.peripheral(unit));
    let make = match context.names.adc.new {
        AdcNew::Unit => format!("Adc::new(p.{hal})"),
        AdcNew::Interrupt => {
            let interrupt = context.interrupt(unit, "GLOBAL")?;
            section.bind(interrupt, format!("hal::adc::InterruptHandler<{hal}>"));
            format!("Adc::new(p.{hal}, Irqs)")
        }
        AdcNew::Resolution => format!("Adc::new(p.{hal}, hal::adc::Resolution::BITS12)"),
        AdcNew::Default => format!("Adc::new(p.{hal}, hal::adc::AdcConfig::default())"),
        AdcNew::Config => {
            let interrupt = context.interrupt(unit, "GLOBAL")?;
            section.bind(interrupt, "hal::adc::InterruptHandler".to_owned());
            format!("Adc::new(p.{hal}, Irqs, hal::adc::Config::default())")
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
        make: make.replace("Adc::new", "hal::adc::Adc::new"),
    });
    section.items.push(format!(
        "type {unit}Unit = Mutex<CriticalSectionRawMutex, {type_}>;\n\
         static {unit}_UNIT: StaticCell<{unit}Unit> = StaticCell::new();"
    ));
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
    let mut pins = String::new();
    for wire in &wires {
        let pin = &lack::pad(wire, Role::In)?.pin.name;
        let (type_, make) = match context.names.hal {
            Hal::Stm32 => (format!("Peri<'static, {pin}>"), format!("p.{pin}")),
            Hal::Rp => rp::analog::input(context, pin),
        };
        pins.push_str(&format!("    mut {}: {type_},\n", wire.ident));
        section.fields.push(Field { name: wire.ident.clone(), comment: wire.place(), type_, make });
    }
    let (mut state, mut reads) = (String::new(), String::new());
    for device in devices {
        let mut own = String::new();
        let pass = filter::pass(context, device.index, section, &mut own);
        if !own.is_empty() {
            state.push_str(&format!("    {own}"));
        }
        reads.push_str(&read(context, converters, device, &pass, section)?);
    }
    let units: Vec<&str> = converters.all.iter().copied().collect();
    let shared =
        converters.lines(|one| format!("    {}: &'static {one}Unit,\n", converters.shared(one)));
    let locks = converters.lines(|one| {
        let (own, shared) = (converters.own(one), converters.shared(one));
        format!("        let mut {own} = {shared}.lock().await;\n")
    });
    let drops = converters.lines(|one| format!("        drop({});\n", converters.own(one)));
    let text = format!(
        "/// {}.\n#[embassy_executor::task]\nasync fn {ident}(\n{shared}{pins}) {{\n{}{state}    \
         let mut ticker = Ticker::every(Duration::from_millis({}));\n    loop {{\n\
         {locks}{reads}{drops}        \
         WATCH.beat(tables::{constant}, now_ms());\n        ticker.next().await;\n    }}\n}}",
        cycle.title(&units.join(" and ")),
        late(cycle),
        cycle.delay_ms,
    );
    section.items.push(text);
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
) -> Printed<String> {
    let names: Vec<String> = (0..wired.wires.len()).map(|at| format!("s{at}")).collect();
    let mut text = format!("        for [{}] in samples.as_chunks_mut().0 {{\n", names.join(", "));
    for (name, wire) in names.iter().zip(&wired.wires) {
        text.push_str(&format!(
            "            *{name} = {}.{call}(&mut {}, hal::adc::SampleTime::{time}){wait};\n",
            converters.own(lack::unit(wire)?),
            wire.ident
        ));
    }
    Ok(text + "        }\n")
}

/// All samples of an input, then those of the next: what sets the converter up takes longer than a sample.
fn columns(
    context: &Context<'_>,
    converters: &Converters<'_>,
    wired: &Wired<'_>,
    time: &str,
    section: &mut Section,
) -> Printed<String> {
    section.features.insert("adc-repeat");
    let count = wired.wires.len();
    let columns = wired.wires.iter().enumerate().map(|(at, wire)| {
        let unit = lack::unit(wire)?;
        let hal = context.peripheral(unit);
        Ok(format!(
            "        let first = {}.blocking_read(&mut {}, hal::adc::SampleTime::{time});\n        \
             rt::repeat::fill(hal::pac::{hal}, first, samples.iter_mut().skip({at}).step_by({count}));\n",
            converters.own(unit),
            wire.ident
        ))
    });
    columns.collect()
}

/// Samples one device.
fn read(
    context: &Context<'_>,
    converters: &Converters<'_>,
    wired: &Wired<'_>,
    filter: &str,
    section: &mut Section,
) -> Printed<String> {
    let analog = lack::kind(wired.first.connection.kind.analog())?;
    let count = wired.wires.len();
    let time = sampling(&context.profile.adc, analog.sampling_cycles);
    let time = time.unwrap_or(context.profile.adc.sample_cycles_default);
    let time = sample_time(time);
    let samples = usize::from(analog.samples.max(1)) * count;
    let mut text = format!("        let mut samples = [0; {samples}];\n");
    text.push_str(&match context.names.adc.read {
        AdcRead::Blocking => rows(converters, wired, "blocking_read", &time, "")?,
        AdcRead::Async => rows(converters, wired, "read", &time, ".await")?,
        AdcRead::Again => columns(context, converters, wired, &time, section)?,
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
        "rt::analog::report(&BOARD, {filter}, tables::{upper}, {}, &{how}, &samples, {count}, &mut [0; {}]);",
        scalar(value.scalar),
        value.size_bytes(),
    );
    text.push_str(&match context.names.adc.read {
        AdcRead::Blocking | AdcRead::Async | AdcRead::Again => format!("        {tell}\n"),
        AdcRead::Checked => rp::analog::tell(&upper, &tell),
    });
    Ok(text)
}

/// `CYCLES84`, `CYCLES1_5`
fn sample_time(cycles: Cycles) -> String {
    let half = if cycles.halves() % 2 == 1 { "_5" } else { "" };
    format!("CYCLES{}{half}", cycles.whole())
}
