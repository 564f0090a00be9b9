//! The user's controllers: a task for each, and the C between the values of the board and the user's code.

use sensedsl_code::{ControllerPlan, FieldPlan, controllers};
use sensedsl_files::{block, templates};
use sensedsl_job::{BoardJob, JobController, JobDevice, Owner};
use sensedsl_wire::Direction;

use crate::context::Context;
use crate::section::{Cost, Section, Work};
use sensedsl_firmware_c::FallBackPlan;

/// An `up_control_state_t`, and a few variables of the user's.
const STATE_BYTES: u32 = 13 + 16;

templates! {
    s: ControlPlan;
    Tables = "control.c.txt";
}

/// The user's code on a board.
#[derive(Clone, Debug)]
pub(crate) struct ControlPlan {
    all: Vec<Control>,
    /// The values that devices of code have at the start.
    first: Vec<FallBackPlan>,
    /// Whom each field obeys, as the runtime calls it.
    owners: Vec<&'static str>,
}

/// An `up_control_t`.
#[derive(Clone, Debug)]
struct Control {
    plan: ControllerPlan,
    every_us: u32,
    takes_us: u32,
    reads: Vec<Access>,
    sets: Vec<Access>,
}

/// A device that is read or set: its field, and the runtime's function.
#[derive(Clone, Debug)]
struct Access {
    ident: String,
    name: String,
    function: &'static str,
}

/// The tasks of the controllers.
pub(crate) fn section(context: &Context<'_>, plan: &ControlPlan) -> Section {
    let mut section = Section::default();
    for (one, control) in context.job.controllers.iter().zip(&plan.all) {
        let Some(device) = context.job.devices.get(one.own) else { continue };
        section.work.push(Work {
            title: format!("{}, every {} ms", device.name(), control.plan.every_ms),
            function: "up_control_cycle",
            table: format!("{}_control", control.plan.ident),
            cycle: device.cycle,
            field: device.name().to_owned(),
        });
        let fields = control.plan.reads.iter().map(|field| field.bytes() + 5);
        let sets = control.plan.sets.iter().map(|field| field.bytes() + 1);
        let bytes: usize = fields.chain(sets).sum();
        let bytes = u32::try_from(bytes).unwrap_or(u32::MAX).saturating_add(STATE_BYTES);
        section.costs.push(Cost::new(format!("the controller {}", device.name()), bytes, 1_500));
    }
    if !plan.is_empty() {
        section.headers.push("up_control.h");
        section.costs.push(Cost::new("controllers", 0, 700));
        section.tables = plan.block();
    }
    section
}

impl ControlPlan {
    pub(crate) fn new(job: &BoardJob<'_>) -> Self {
        let plans = controllers(job);
        let all = plans.into_iter().zip(&job.controllers);
        Self {
            all: all.map(|(plan, own)| Control::new(job, plan, own)).collect(),
            first: job.devices.iter().filter_map(first).collect(),
            owners: (0..job.devices.len()).map(|index| owner(job, index)).collect(),
        }
    }

    /// Whether there are none.
    pub(crate) fn is_empty(&self) -> bool {
        self.all.is_empty() && self.first.is_empty()
    }

    /// What the code of each gets and gives.
    pub(crate) fn plans(&self) -> Vec<ControllerPlan> {
        self.all.iter().map(|one| one.plan.clone()).collect()
    }

    /// Whether one of them sets the device.
    pub(crate) fn sets(&self, device: &str) -> bool {
        self.all.iter().any(|one| one.sets.iter().any(|set| set.name == device))
    }

    /// The tables.
    pub(crate) fn block(&self) -> String {
        block(&Tables { s: self })
    }
}

impl Control {
    fn new(job: &BoardJob<'_>, plan: ControllerPlan, own: &JobController<'_>) -> Self {
        let every_us = own.controller.every_ms.saturating_mul(1_000);
        let accesses = |fields: &[FieldPlan], function: fn(&JobDevice<'_>) -> &'static str| {
            let one = |field: &FieldPlan| {
                let device = job.devices.get(field.index)?;
                let (ident, name) = (field.ident.clone(), device.name().to_owned());
                Some(Access { ident, name, function: function(device) })
            };
            fields.iter().filter_map(one).collect()
        };
        Self {
            every_us,
            takes_us: own.controller.takes_us.unwrap_or(every_us),
            reads: accesses(&plan.reads, read),
            sets: accesses(&plan.sets, sets),
            plan,
        }
    }
}

/// A value that nobody measures is good as soon as it is there.
fn read(one: &JobDevice<'_>) -> &'static str {
    let is_given = one.device.kind.code().is_some() || one.device.direction == Direction::Actuator;
    if is_given { "up_control_given" } else { "up_control_get" }
}

fn sets(one: &JobDevice<'_>) -> &'static str {
    match one.device.direction {
        Direction::Actuator => "up_control_set",
        Direction::Sensor => "up_control_report",
    }
}

fn first(one: &JobDevice<'_>) -> Option<FallBackPlan> {
    one.device.kind.code().map(|code| FallBackPlan::of(one, code.default))
}

fn owner(job: &BoardJob<'_>, index: usize) -> &'static str {
    match job.owner(index) {
        Owner::Host => "UP_OWNER_HOST",
        Owner::Code => "UP_OWNER_CODE",
        Owner::CodeOrHost => "UP_OWNER_CODE_OR_HOST",
    }
}
