//! `GPIOv2`: lines that get a pulse each cycle.

use std::collections::BTreeMap;

use askama::Template;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::kind::icu::Icu;
use sensedsl_model::kind::{Kind, KindName, Role};

use crate::firmware::chibios::context::Context;
use crate::firmware::chibios::section::{STACK_BYTES, Section, Work};
use crate::job::Cycle;
use crate::print::block;

#[derive(Template)]
#[template(path = "firmware/chibios/pulse/v2.c.txt", escape = "none")]
struct Tables<'a> {
    s: &'a Pulses,
}

struct Pulses {
    pulses: Vec<Pulse>,
}

/// Lines that get a pulse at the same time.
struct Pulse {
    index: usize,
    cycle: Cycle,
    pulse_us: u32,
    /// The identifier of the first device.
    id: u8,
    lines: Vec<String>,
    names: Vec<String>,
}

pub(super) fn plan(context: &Context<'_>, diagnostics: &mut Vec<Diagnostic>) -> Section {
    let mut section = Section::default();
    let mut classes: BTreeMap<(Cycle, u32), (u8, Vec<String>, Vec<String>)> = BTreeMap::new();
    for wired in context.devices(KindName::Icu) {
        let Kind::Icu(Icu { pulse_us: Some(pulse_us), .. }) = wired.device.kind else { continue };
        let Some(pad) = wired.pad(Role::Trigger) else { continue };
        let Some(pad) = context.pad(pad, "PAL_MODE_OUTPUT_PUSHPULL", diagnostics) else { continue };
        let id = wired.device.id.value;
        let first = || (id, Vec::new(), Vec::new());
        let (_, lines, names) = classes.entry((wired.cycle, pulse_us)).or_insert_with(first);
        lines.push(pad.line.clone());
        names.push(wired.name().to_owned());
        section.pads.push(pad);
    }
    let classes = classes.into_iter().enumerate();
    let pulses: Vec<Pulse> = classes
        .map(|(index, ((cycle, pulse_us), (id, lines, names)))| Pulse {
            index,
            cycle,
            pulse_us,
            id,
            lines,
            names,
        })
        .collect();
    section.work = pulses.iter().map(Pulse::work).collect();
    if !pulses.is_empty() {
        section.tables = block(&Tables { s: &Pulses { pulses } });
    }
    section
}

impl Pulse {
    fn work(&self) -> Work {
        Work {
            unit: "pulse".to_owned(),
            cycle: self.cycle,
            function: "up_pulse_cycle",
            table: format!("pulse_{}", self.index),
            device: self.id,
            stack_bytes: STACK_BYTES,
        }
    }
}
