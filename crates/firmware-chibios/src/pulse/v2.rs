//! All versions: lines that get a pulse in each cycle.

use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::kind::Role;

use crate::context::Context;
use crate::section::{Section, Work};
use crate::stacks::Depth;
use sensedsl_files::{block, templates};
use sensedsl_job::Cycle;
use sensedsl_job::kinds;

/// The stack depth of its thread.
const DEPTH: Depth = Depth { plain: [168, 152], filtered: [168, 152] };

templates! {
    s: Pulses;
    Tables = "pulse/v2.c.txt";
}

struct Pulses {
    pulses: Vec<Pulse>,
}

/// Lines that get a pulse in the same cycle.
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
    /// The time from its pulse to the next.
    apart_ms: u32,
}

pub(super) fn plan(context: &Context<'_>, diagnostics: &mut Vec<Diagnostic>) -> Section {
    let mut section = Section::default();
    let all = kinds::pulse::pulses(context.job);
    let several = |cycle: &Cycle| all.iter().filter(|other| other.cycle == *cycle).count() > 1;
    let mut pulses = Vec::new();
    for one in &all {
        let mut lines = Vec::new();
        for line in &one.lines {
            let Some(pad) = line.wire.pad(Role::Trigger) else { continue };
            let plan = context.pad(pad, "PAL_MODE_OUTPUT_PUSHPULL", diagnostics);
            let Some(plan) = plan else { continue };
            let (place, apart_ms) = (line.wire.place(), line.apart_ms);
            lines.push(Line { place, line: plan.line.clone(), apart_ms });
            section.pads.push(plan);
        }
        let kinds::pulse::Pulses { cycle, pulse_us, id, .. } = *one;
        let ident = name(cycle, pulse_us, several(&cycle));
        pulses.push(Pulse { ident, cycle, pulse_us, id, lines });
    }
    section.work = pulses.iter().map(Pulse::work).collect();
    if !pulses.is_empty() {
        section.tables = block(&Tables { s: &Pulses { pulses } });
    }
    section
}

/// `pulse_100ms`, with the pulse length if one cycle has pulses of several lengths.
fn name(cycle: Cycle, pulse_us: u32, is_one_of_several: bool) -> String {
    let name = cycle.ident("pulse");
    if is_one_of_several { format!("{name}_{pulse_us}us") } else { name }
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
