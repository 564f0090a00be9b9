//! All decisions about the firmware of a board, ready to be printed.

use sensedsl_diagnostics::Diagnostic;

use super::board::{self, TreePlan};
use super::context::{Context, PadPlan};
use super::control::ControlPlan;
use super::doctor::{self, DoctorPlan};
use super::fallback;
use super::link::{self, ButtonPlan, LinkPlan};
use super::missed;
use super::parts::{self, PartsPlan};
use super::peripherals;
use super::section::{Apply, Counter, GuardPlan, Probe, Section, Size, Work};
use super::settings::{self, SettingsPlan};
use sensedsl_firmware_c::{FallBackPlan, Role, SchemaPlan};
use sensedsl_job::BoardJob;
use sensedsl_job::part::uses_in_c;

/// The firmware of one board.
#[derive(Clone, Debug)]
pub(super) struct BoardPlan {
    pub(super) name: String,
    pub(super) tree: TreePlan,
    pub(super) settings: SettingsPlan,
    pub(super) schema: SchemaPlan,
    /// Compiler options for the parts of the core that no value needs.
    pub(super) left_out: Vec<String>,
    pub(super) pads: Vec<PadPlan>,
    pub(super) parts: PartsPlan,
    pub(super) doctor: DoctorPlan,
    pub(super) sections: Vec<Section>,
    pub(super) tasks: Vec<TaskPlan>,
    pub(super) link: LinkPlan,
    pub(super) button: Option<ButtonPlan>,
    pub(super) report_ms: u32,
    /// The cycle time of each value; 0 if it comes only when something happens.
    pub(super) cycles_ms: Vec<u32>,
    pub(super) silence_ms: u32,
    /// The values that are set when the host falls silent, besides what sections do.
    pub(super) fall_backs: Vec<FallBackPlan>,
    pub(super) guards: Vec<GuardPlan>,
    /// The user's code that runs in cycles.
    pub(super) controllers: ControlPlan,
}

/// One thread.
#[derive(Clone, Debug)]
pub(super) struct TaskPlan {
    /// `ADC1 60 ms +2`
    pub(super) name: String,
    /// The runtime's function and its table.
    pub(super) function: &'static str,
    pub(super) work: String,
    pub(super) delay_ms: u32,
    pub(super) prio: i8,
    pub(super) start_ms: u32,
    /// The identifier of the first device that it serves.
    pub(super) device: u8,
    pub(super) stack_bytes: u32,
}

/// Decides the firmware of a board. What the hardware or the system cannot do is reported.
pub(super) fn plan(context: &Context<'_>, diagnostics: &mut Vec<Diagnostic>) -> Option<BoardPlan> {
    let mut pads = Vec::new();
    let link = link::plan(context, &mut pads, diagnostics)?;
    let sections = peripherals::sections(context, diagnostics);
    pads.extend(sections.iter().flat_map(|section| section.pads.iter().cloned()));
    pads.sort();
    pads.dedup();
    missed::report(context, &pads, &sections, diagnostics);
    let work = sections.iter().flat_map(|section| &section.work);
    let tasks: Vec<TaskPlan> = work.map(|work| TaskPlan::new(context, work)).collect();
    let settings = settings::plan(context, &sections, &link);
    Some(BoardPlan {
        name: context.job.board.name.value.clone(),
        tree: board::plan(context),
        schema: SchemaPlan::new(&context.job.schema, Role::Board),
        left_out: left_out(context.job),
        report_ms: link::report_ms(context, &tasks),
        cycles_ms: context.job.cycles_ms(),
        silence_ms: context.job.board.link.silence_ms.unwrap_or(0),
        fall_backs: fallback::of_host(context),
        controllers: ControlPlan::new(context, &sections),
        button: link::button(context),
        guards: settings::guards(context, &sections, &settings),
        settings,
        parts: parts::plan(context),
        doctor: doctor::plan(context),
        pads,
        sections,
        tasks,
        link,
    })
}

impl BoardPlan {
    /// The sizes that drivers need the runtime to be compiled with.
    pub(super) fn sizes(&self) -> impl Iterator<Item = &Size> {
        self.sections.iter().flat_map(|section| &section.sizes)
    }

    /// The headers of the drivers in use.
    pub(super) fn headers(&self) -> Vec<&'static str> {
        let all = self.sections.iter().flat_map(|section| section.headers.iter().copied());
        let mut all: Vec<&str> = all.collect();
        all.sort_unstable();
        all.dedup();
        all
    }

    /// The counters of drivers.
    pub(super) fn counters(&self) -> Vec<&Counter> {
        self.sections.iter().flat_map(|section| &section.counters).collect()
    }

    /// The buses that can be scanned.
    pub(super) fn probes(&self) -> Vec<&Probe> {
        self.sections.iter().flat_map(|section| &section.probes).collect()
    }

    /// The lines that start the drivers.
    pub(super) fn starts(&self) -> Vec<&str> {
        self.lines(|section| &section.starts)
    }

    /// The lines that the reporter runs in each cycle.
    pub(super) fn polls(&self) -> Vec<&str> {
        self.lines(|section| &section.polls)
    }

    /// The lines that bring the host's actuators to their failsafe state.
    pub(super) fn failsafes(&self) -> Vec<&str> {
        let all = self.sections.iter().flat_map(|section| &section.failsafes);
        let hosts =
            all.filter(|one| !one.field.as_ref().is_some_and(|name| self.controllers.sets(name)));
        hosts.map(|one| one.line.as_str()).collect()
    }

    /// The lines that run when an actuator is set.
    pub(super) fn applies(&self) -> Vec<&Apply> {
        self.sections.iter().flat_map(|section| &section.applies).collect()
    }

    fn lines(&self, of: fn(&Section) -> &Vec<String>) -> Vec<&str> {
        self.sections.iter().flat_map(of).map(String::as_str).collect()
    }
}

impl TaskPlan {
    fn new(context: &Context<'_>, work: &Work) -> Self {
        Self {
            name: work.cycle.title(&work.unit),
            function: work.function,
            work: work.table.clone(),
            delay_ms: work.cycle.delay_ms,
            prio: work.cycle.prio,
            start_ms: work.cycle.start_ms,
            device: work.device,
            stack_bytes: work.depth.stack_bytes(context),
        }
    }
}

/// The parts left out of the core, as compiler options (`-D`).
fn left_out(job: &BoardJob<'_>) -> Vec<String> {
    let unused = uses_in_c(job).into_iter().filter(|(_, is_used)| !is_used);
    unused.map(|(name, _)| format!("UP_USES_{}=0", name.to_uppercase().replace('-', "_"))).collect()
}
