//! Analog inputs: a task for each converter and cycle.

use std::collections::BTreeSet;

use sensedsl_board::profile::Cycles;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::kind::{KindName, Role};
use sensedsl_timing::sampling;

use super::context::{Context, Wired, late, scalar};
use super::filter;
use super::names::{AdcNew, AdcRead};
use super::section::{Field, Section, Start, Watched};
use crate::job::Cycle;
use crate::print::snake;

pub(super) fn plan(context: &Context<'_>, _: &mut Vec<Diagnostic>) -> Section {
    let mut section = Section::default();
    let mut units = BTreeSet::new();
    for ((unit, cycle), devices) in context.classes(KindName::Analog) {
        if units.insert(unit.clone()) {
            self::unit(context, &unit, &mut section);
        }
        for wire in devices.iter().flat_map(|one| &one.wires) {
            let Some(pad) = wire.pad(Role::In) else { continue };
            section.fields.push(Field {
                name: wire.ident.clone(),
                comment: wire.place(),
                type_: format!("Peri<'static, {}>", pad.pin.name),
                make: format!("p.{}", pad.pin.name),
            });
        }
        task(context, &unit, cycle, &devices, &mut section);
    }
    section
}

/// The converter, which tasks of several cycles share.
fn unit(context: &Context<'_>, unit: &str, section: &mut Section) {
    let (name, hal) = (snake(unit), context.peripheral(unit));
    let make = match context.names.adc.new {
        AdcNew::Unit => format!("Adc::new(p.{hal})"),
        AdcNew::Interrupt => {
            if let Some(interrupt) = context.names.interrupt(unit, "GLOBAL") {
                section.bind(interrupt, format!("hal::adc::InterruptHandler<{hal}>"));
            }
            format!("Adc::new(p.{hal}, Irqs)")
        }
        AdcNew::Resolution => format!("Adc::new(p.{hal}, hal::adc::Resolution::BITS12)"),
        AdcNew::Default => format!("Adc::new(p.{hal}, hal::adc::AdcConfig::default())"),
    };
    section.fields.push(Field {
        name: name.clone(),
        comment: format!("{unit}, which converts"),
        type_: format!("hal::adc::Adc<'static, {hal}>"),
        make: make.replace("Adc::new", "hal::adc::Adc::new"),
    });
    section.items.push(format!(
        "type {unit}Unit = Mutex<CriticalSectionRawMutex, hal::adc::Adc<'static, {hal}>>;\n\
         static {unit}_UNIT: StaticCell<{unit}Unit> = StaticCell::new();"
    ));
    section.starts.push(Start::Make(format!(
        "let {name}: &'static {unit}Unit = {unit}_UNIT.init(Mutex::new(wiring.{name}));"
    )));
    section.runtime.insert("analog.rs");
}

fn task(
    context: &Context<'_>,
    unit: &str,
    cycle: Cycle,
    devices: &[Wired<'_>],
    section: &mut Section,
) {
    let ident = cycle.ident(unit);
    let constant = ident.to_uppercase();
    let wires: Vec<_> = devices.iter().flat_map(|one| &one.wires).collect();
    let pins = wires.iter().filter_map(|wire| {
        Some(format!("    mut {}: Peri<'static, {}>,\n", wire.ident, wire.pad(Role::In)?.pin.name))
    });
    let (mut state, mut reads) = (String::new(), String::new());
    for device in devices {
        let mut own = String::new();
        let pass = filter::pass(context, device.index, section, &mut own);
        if !own.is_empty() {
            state.push_str(&format!("    {own}"));
        }
        reads.push_str(&read(context, device, &pass, section));
    }
    let mut text = format!(
        "/// {}.\n#[embassy_executor::task]\nasync fn {ident}(\n    unit: &'static {unit}Unit,\n{}) {{\n{}{state}    \
         let mut ticker = Ticker::every(Duration::from_millis({}));\n    loop {{\n        \
         let mut adc = unit.lock().await;\n",
        cycle.title(unit),
        pins.collect::<String>(),
        late(cycle),
        cycle.delay_ms,
    );
    text.push_str(&reads);
    text.push_str(&format!(
        "        drop(adc);\n        WATCH.beat(tables::{constant}, now_ms());\n        ticker.next().await;\n    }}\n}}"
    ));
    section.items.push(text);
    let arguments: Vec<String> =
        wires.iter().map(|wire| format!(", wiring.{}", wire.ident)).collect();
    let call = format!("{ident}({}{})", snake(unit), arguments.concat());
    section.starts.push(Start::Task(cycle.prio, call));
    let device = wires.first().map_or(0, |wire| context.id_of(wire));
    section.watched.push(Watched::new(constant, cycle, device));
}

/// All inputs one right after the other, as often as there are samples.
fn rows(wired: &Wired<'_>, call: &str, time: &str, wait: &str) -> String {
    let names: Vec<String> = (0..wired.wires.len()).map(|at| format!("s{at}")).collect();
    let mut text = format!("        for [{}] in samples.as_chunks_mut().0 {{\n", names.join(", "));
    for (name, wire) in names.iter().zip(&wired.wires) {
        text.push_str(&format!(
            "            *{name} = adc.{call}(&mut {}, SampleTime::{time}){wait};\n",
            wire.ident
        ));
    }
    text + "        }\n"
}

/// All samples of an input, then those of the next: what sets the converter up takes longer than a sample.
fn columns(context: &Context<'_>, wired: &Wired<'_>, time: &str, section: &mut Section) -> String {
    section.runtime.insert("again.rs");
    let count = wired.wires.len();
    let columns = wired.wires.iter().enumerate().filter_map(|(at, wire)| {
        let hal = context.peripheral(wire.unit?);
        Some(format!(
            "        let first = adc.blocking_read(&mut {}, SampleTime::{time});\n        \
             rt::again::fill(hal::pac::{hal}, first, samples.iter_mut().skip({at}).step_by({count}));\n",
            wire.ident
        ))
    });
    columns.collect()
}

/// Samples one device.
fn read(context: &Context<'_>, wired: &Wired<'_>, filter: &str, section: &mut Section) -> String {
    let Some(analog) = wired.wires.first().and_then(|one| one.connection.kind.analog()) else {
        return String::new();
    };
    let count = wired.wires.len();
    let time = sampling(&context.profile.adc, analog.sampling_cycles);
    let time = time.unwrap_or(context.profile.adc.sample_cycles_default);
    let time = sample_time(time);
    let samples = usize::from(analog.samples.max(1)) * count;
    let mut text = format!("        let mut samples = [0; {samples}];\n");
    text.push_str(&match context.names.adc.read {
        AdcRead::Blocking => rows(wired, "blocking_read", &time, ""),
        AdcRead::Async => rows(wired, "read", &time, ".await"),
        AdcRead::Again => columns(context, wired, &time, section),
    });
    let value = wired.device.device.value.value;
    let upper = wired.device.ident.to_uppercase();
    let formula = wired.wires.first().and_then(|one| {
        let mut formulas = context.job.tables_of(one)?.formulas.iter();
        formulas.find(|plan| plan.field == wired.device.name())
    });
    let how = match formula {
        Some(plan) => {
            let parameters: Vec<String> = plan.parameters.iter().map(ToString::to_string).collect();
            format!(
                "rt::analog::Value::Computed(&sense_rt::{}, {}, &[{}])",
                plan.formula.trim_start_matches("up_formula_").to_uppercase(),
                plan.output,
                parameters.join(", ")
            )
        }
        None => "rt::analog::Value::Mean".to_owned(),
    };
    text.push_str(&format!(
        "        rt::analog::tell(&BOARD, {filter}, tables::{upper}, {}, {how}, &samples, {count}, &mut [0; {}]);\n",
        scalar(value.scalar),
        value.size_bytes(),
    ));
    text
}

/// `CYCLES84`, `CYCLES1_5`
fn sample_time(cycles: Cycles) -> String {
    let half = if cycles.halves() % 2 == 1 { "_5" } else { "" };
    format!("CYCLES{}{half}", cycles.whole())
}
