//! Controllers in; a thread for each, and the C between the values of the board and the user's code, out.

use sensedsl_code::{ControllerPlan, controllers};
use sensedsl_diagnostics::Diagnostic;
use sensedsl_job::{BoardJob, JobController, JobDevice};

use crate::context::Context;
use crate::section::{Section, Work};
use crate::stacks::Depth;
use sensedsl_files::{block, templates};
use sensedsl_firmware_c::FallBackPlan;
use sensedsl_firmware_c::control::{self, Access};

templates! {
    s: ControlPlan;
    Tables = "control/control.c.txt";
}

/// What the user's code takes of a stack is not known: room for some calls and a few hundred bytes of variables.
const DEPTH: Depth = Depth { plain: [1_600, 1_600], filtered: [1_800, 1_800] };
/// The guard sets failsafe values, and counts.
const GUARD_DEPTH: Depth = Depth { plain: [600, 600], filtered: [800, 800] };

/// The user's code on a board.
#[derive(Clone, Debug)]
pub(crate) struct ControlPlan {
    all: Vec<Control>,
    /// The values that devices of code have at the start.
    first: Vec<FallBackPlan>,
    /// Whom each field obeys, as the runtime calls it.
    owners: Vec<&'static str>,
    /// The parameters that survive a reset.
    kept: Vec<Kept>,
    kept_words: usize,
    /// Above all controllers, relative to the usual priority.
    guard_prio: i16,
    guard_stack_bytes: u32,
}

/// An `up_control_t`.
#[derive(Clone, Debug)]
struct Control {
    plan: ControllerPlan,
    takes_us: u32,
    reads: Vec<Access>,
    sets: Vec<Access>,
    /// What is set when it hangs: values, and lines of drivers.
    fall_backs: Vec<FallBackPlan>,
    failsafes: Vec<String>,
}

/// An `up_kept_t`.
#[derive(Clone, Debug)]
struct Kept {
    name: String,
    offset: usize,
}

/// The threads, and what starts them.
pub(super) fn section(context: &Context<'_>, _: &mut Vec<Diagnostic>) -> Section {
    let mut section = Section::default();
    for one in &context.job.controllers {
        let Some(device) = context.job.devices.get(one.own) else { continue };
        section.work.push(Work {
            unit: device.name().to_owned(),
            cycle: device.cycle,
            function: "up_control_cycle",
            table: format!("{}_control", sensedsl_code::controller_ident(&one.ident)),
            device: device.device.id.value,
            depth: DEPTH,
        });
    }
    if !section.work.is_empty() {
        section.starts.push("up_control_start(&controls);".to_owned());
    }
    section
}

impl ControlPlan {
    /// `sections`: of all drivers, which know how their outputs fall back.
    pub(crate) fn new(context: &Context<'_>, sections: &[Section]) -> Self {
        let job = context.job;
        let plans = controllers(job);
        let all = plans.into_iter().zip(&job.controllers);
        let (kept, kept_bytes) = kept(job);
        Self {
            all: all.map(|(plan, own)| Control::new(job, plan, own, sections)).collect(),
            first: control::first_values(job),
            owners: control::owners(job),
            kept,
            kept_words: kept_bytes.div_ceil(4),
            guard_prio: job.controllers.iter().map(|one| prio(job, one)).max().unwrap_or(0) + 1,
            guard_stack_bytes: GUARD_DEPTH.stack_bytes(context),
        }
    }

    /// Whether there are none.
    pub(crate) fn is_empty(&self) -> bool {
        self.all.is_empty()
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
    fn new(
        job: &BoardJob<'_>,
        plan: ControllerPlan,
        own: &JobController<'_>,
        sections: &[Section],
    ) -> Self {
        let every_us = own.controller.every_ms.saturating_mul(1_000);
        let set: Vec<&JobDevice<'_>> =
            own.sets.iter().filter_map(|index| job.devices.get(*index)).collect();
        let lines = sections
            .iter()
            .flat_map(|section| &section.failsafes)
            .filter(|line| set.iter().any(|one| line.field.as_deref() == Some(one.name())));
        Self {
            takes_us: own.controller.takes_us.unwrap_or(every_us),
            reads: control::reads(job, &plan.reads),
            sets: control::sets(job, &plan.sets),
            plan,
            fall_backs: set.iter().filter_map(|one| FallBackPlan::new(one)).collect(),
            failsafes: lines.map(|line| line.line.clone()).collect(),
        }
    }

    fn has_failsafe(&self) -> bool {
        !self.fall_backs.is_empty() || !self.failsafes.is_empty()
    }
}

fn prio(job: &BoardJob<'_>, one: &JobController<'_>) -> i16 {
    job.devices.get(one.own).map_or(0, |own| i16::from(own.cycle.prio))
}

/// The parameters that are kept, and the bytes that they take.
fn kept(job: &BoardJob<'_>) -> (Vec<Kept>, usize) {
    let mut offset = 0;
    let mut all = Vec::new();
    for one in &job.devices {
        if one.device.kind.code().is_some_and(|code| code.is_stored) {
            all.push(Kept { name: one.name().to_owned(), offset });
            offset += one.device.value.value.size_bytes();
        }
    }
    (all, offset)
}
