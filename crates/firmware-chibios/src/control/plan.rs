//! Controllers in; a thread for each, and the C between the values of the board and the user's code, out.

use sensedsl_code::{ControllerPlan, controllers};
use sensedsl_diagnostics::Diagnostic;
use sensedsl_wire::Direction;

use crate::context::Context;
use crate::section::{Section, Work};
use crate::stacks::Depth;
use sensedsl_files::{block, templates};

templates! {
    s: Controllers;
    Tables = "control/control.c.txt";
}

struct Controllers {
    all: Vec<Control>,
    /// The values that devices of code have at the start.
    first: Vec<First>,
}

/// An `up_control_t`.
struct Control {
    plan: ControllerPlan,
    /// The name in the file.
    name: String,
    takes_us: u32,
    sets: Vec<Set>,
}

/// A device that is set: its field, and whether it is an actuator.
struct Set {
    ident: String,
    name: String,
    is_actuator: bool,
}

/// The value of a device of code at the start.
struct First {
    name: String,
    c_type: &'static str,
    elements: Vec<String>,
}

/// What the user's code takes of a stack is not known: room for some calls and a few hundred bytes of variables.
const DEPTH: Depth = Depth { plain: [1_600, 1_600], filtered: [1_800, 1_800] };

pub(super) fn plan(context: &Context<'_>, _: &mut Vec<Diagnostic>) -> Section {
    let mut section = Section::default();
    let mut all = Vec::new();
    for (plan, own) in controllers(context.job).into_iter().zip(&context.job.controllers) {
        let Some(device) = context.job.devices.get(own.own) else { continue };
        section.work.push(Work {
            unit: device.name().to_owned(),
            cycle: device.cycle,
            function: "up_control_cycle",
            table: format!("{}_control", own.ident),
            device: device.device.id.value,
            depth: DEPTH,
        });
        let every_us = own.controller.every_ms.saturating_mul(1_000);
        let sets = own.sets.iter().filter_map(|&index| context.job.devices.get(index));
        all.push(Control {
            plan,
            name: device.name().to_owned(),
            takes_us: own.controller.takes_us.unwrap_or(every_us),
            sets: sets
                .map(|one| Set {
                    ident: one.ident.clone(),
                    name: one.name().to_owned(),
                    is_actuator: one.device.direction == Direction::Actuator,
                })
                .collect(),
        });
    }
    if !all.is_empty() {
        section.starts.push("up_control_start();".to_owned());
        section.tables = block(&Tables { s: &Controllers { all, first: Vec::new() } });
    }
    section
}
