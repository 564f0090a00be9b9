//! The user's controllers: a task for each, and the C between the values of the board and the user's code.

use sensedsl_code::{ControllerPlan, controllers};
use sensedsl_files::{block, templates};
use sensedsl_job::{BoardJob, JobController};

use crate::context::Context;
use crate::section::{Cost, Section, Work};
use sensedsl_firmware_c::FallBackPlan;
use sensedsl_firmware_c::control::{self, Access};

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
            first: control::first_values(job),
            owners: control::owners(job),
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
        Self {
            every_us,
            takes_us: own.controller.takes_us.unwrap_or(every_us),
            reads: control::reads(job, &plan.reads),
            sets: control::sets(job, &plan.sets),
            plan,
        }
    }
}
