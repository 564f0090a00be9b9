//! Pulses that make rangers measure: a task for each cycle and length.

use std::collections::BTreeMap;

use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::design::Design;
use sensedsl_model::kind::{KindName, Role};

use super::context::{Context, late};
use super::lack;
use super::section::{Field, Section, Start, Watched};
use crate::job::Cycle;

/// Between two measurements.
const GAP_MS: u32 = 1;

/// A wire with the pulse.
struct Line {
    ident: String,
    /// Those of one group would hear each other.
    group: Option<String>,
    measuring_ms: u32,
    /// From its pulse to the next.
    apart_ms: u32,
}

pub(super) fn plan(context: &Context<'_>, diagnostics: &mut Vec<Diagnostic>) -> Section {
    let mut section = Section::default();
    let mut classes: BTreeMap<(Cycle, u32), (u8, Vec<Line>)> = BTreeMap::new();
    for wired in context.wired(KindName::Icu) {
        let device = wired.device.device;
        let Some(pulse_us) = device.kind.icu().and_then(|icu| icu.pulse_us) else { continue };
        for wire in &wired.wires {
            let pad = match lack::pad(wire, Role::Trigger) {
                Ok(pad) => pad,
                Err(lack) => {
                    context.tell(wire.part, Err(lack), diagnostics);
                    continue;
                }
            };
            let ident = format!("{}_trigger", wire.ident);
            section.fields.push(Field {
                name: ident.clone(),
                comment: format!("{}: the pulse that makes it measure", wire.title),
                type_: "Output<'static>".to_owned(),
                make: format!("Output::new(p.{}, Level::Low, Speed::Low)", pad.pin.name),
            });
            let first = || (device.id.value, Vec::new());
            let (_, lines) = classes.entry((wired.device.cycle, pulse_us)).or_insert_with(first);
            lines.push(Line {
                ident,
                group: device.group.as_ref().map(|group| group.name.clone()),
                measuring_ms: Design::measuring_us(device).div_ceil(1_000) + GAP_MS,
                apart_ms: 0,
            });
        }
    }
    for ((cycle, pulse_us), (device, lines)) in classes {
        task(cycle, pulse_us, device, apart(lines), &mut section);
    }
    section
}

/// Lines of one group wait for each other: elements of an array, and devices whose cycle is too short for turns.
fn apart(mut lines: Vec<Line>) -> Vec<Line> {
    // Those of other groups first, so that nobody waits for what it does not hear.
    lines.sort_by(|a, b| a.group.cmp(&b.group));
    let next: Vec<Option<String>> = lines.iter().skip(1).map(|line| line.group.clone()).collect();
    for (line, next) in lines.iter_mut().zip(next) {
        if line.group.is_some() && line.group == next {
            line.apart_ms = line.measuring_ms;
        }
    }
    lines
}

fn task(cycle: Cycle, pulse_us: u32, device: u8, lines: Vec<Line>, section: &mut Section) {
    let ident = format!("{}_{pulse_us}us", cycle.ident("pulse"));
    let constant = ident.to_uppercase();
    let (mut parameters, mut arguments, mut pulses) = (Vec::new(), Vec::new(), String::new());
    for line in lines {
        parameters.push(format!("mut {}: Output<'static>", line.ident));
        arguments.push(format!("wiring.{}", line.ident));
        pulses.push_str(&format!(
            "        rt::capture::pulse(&mut {}, {pulse_us}).await;\n",
            line.ident
        ));
        if line.apart_ms > 0 {
            pulses.push_str(&format!("        Timer::after_millis({}).await;\n", line.apart_ms));
        }
    }
    section.items.push(format!(
        "/// {}.\n#[embassy_executor::task]\nasync fn {ident}({}) {{\n{}    \
         let mut ticker = Ticker::every(Duration::from_millis({}));\n    loop {{\n{pulses}        \
         WATCH.beat(tables::{constant}, now_ms());\n        ticker.next().await;\n    }}\n}}",
        cycle.title("pulse"),
        parameters.join(", "),
        late(cycle),
        cycle.delay_ms
    ));
    let call = format!("{ident}({})", arguments.join(", "));
    section.starts.push(Start::Task(cycle.prio, call));
    section.watched.push(Watched::new(constant, cycle, device));
    section.runtime.insert("capture.rs");
}
