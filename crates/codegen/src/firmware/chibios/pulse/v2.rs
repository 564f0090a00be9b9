//! All versions: lines that get a pulse each cycle.

use std::collections::BTreeMap;

use askama::Template;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::design::Design;
use sensedsl_model::kind::{KindName, Role};

use crate::firmware::chibios::context::Context;
use crate::firmware::chibios::section::{Section, Work};
use crate::firmware::chibios::stacks::Depth;
use crate::firmware::chibios::timers;
use crate::job::Cycle;
use crate::print::block;

/// How deep its thread gets.
const DEPTH: Depth = Depth { plain: [168, 152], filtered: [168, 152] };

#[derive(Template)]
#[template(path = "firmware/chibios/pulse/v2.c.txt", escape = "none")]
struct Tables<'a> {
    s: &'a Pulses,
}

struct Pulses {
    pulses: Vec<Pulse>,
}

/// Lines that get a pulse in one cycle.
struct Pulse {
    ident: String,
    cycle: Cycle,
    pulse_us: u32,
    /// The identifier of the first device.
    id: u8,
    lines: Vec<Line>,
}

struct Line {
    place: String,
    line: String,
    /// Those of one group would hear each other.
    group: Option<String>,
    measuring_ms: u32,
    /// From its pulse to the next.
    apart_ms: u32,
}

/// Between two measurements, as for those of different cycles: a tick of the kernel.
const GAP_MS: u32 = 1;

pub(super) fn plan(context: &Context<'_>, diagnostics: &mut Vec<Diagnostic>) -> Section {
    let mut section = Section::default();
    let mut classes: BTreeMap<(Cycle, u32), (u8, Vec<Line>)> = BTreeMap::new();
    for (device, wires) in timers::devices(context, KindName::Icu) {
        let Some(pulse_us) = device.device.kind.icu().and_then(|icu| icu.pulse_us) else {
            continue;
        };
        for wired in wires {
            let Some(pad) = wired.pad(Role::Trigger) else { continue };
            let plan = context.pad(pad, "PAL_MODE_OUTPUT_PUSHPULL", diagnostics);
            let Some(plan) = plan else { continue };
            let first = || (context.id_of(wired), Vec::new());
            let (_, lines) = classes.entry((device.cycle, pulse_us)).or_insert_with(first);
            lines.push(Line {
                place: wired.place(),
                line: plan.line.clone(),
                group: device.device.group.as_ref().map(|group| group.name.clone()),
                measuring_ms: Design::measuring_us(device.device).div_ceil(1_000) + GAP_MS,
                apart_ms: 0,
            });
            section.pads.push(plan);
        }
    }
    let several = |cycle: &Cycle| classes.keys().filter(|(other, _)| other == cycle).count() > 1;
    let names: Vec<String> =
        classes.keys().map(|(cycle, pulse_us)| name(*cycle, *pulse_us, several(cycle))).collect();
    let pulses = classes.into_iter().zip(names);
    let pulses: Vec<Pulse> = pulses
        .map(|(((cycle, pulse_us), (id, lines)), ident)| Pulse {
            ident,
            cycle,
            pulse_us,
            id,
            lines: apart(lines),
        })
        .collect();
    section.work = pulses.iter().map(Pulse::work).collect();
    if !pulses.is_empty() {
        section.tables = block(&Tables { s: &Pulses { pulses } });
    }
    section
}

/// `pulse_100ms`, and the length where pulses of several lengths have one cycle.
fn name(cycle: Cycle, pulse_us: u32, is_one_of_several: bool) -> String {
    let name = cycle.ident("pulse");
    if is_one_of_several { format!("{name}_{pulse_us}us") } else { name }
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

impl Pulse {
    fn work(&self) -> Work {
        Work {
            unit: "pulse".to_owned(),
            cycle: self.cycle,
            function: "up_pulse_cycle",
            table: self.ident.clone(),
            device: self.id,
            depth: DEPTH,
        }
    }
}
