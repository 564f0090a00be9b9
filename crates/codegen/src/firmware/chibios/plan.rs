//! All decisions about the firmware of a board, ready to be printed.

use sensedsl_diagnostics::Diagnostic;

use super::board::{self, TreePlan};
use super::context::{Context, PadPlan};
use super::link::{self, ButtonPlan, LinkPlan};
use super::schema::SchemaPlan;
use super::section::{self, GuardPlan, Section, Size, Work};
use super::settings::{self, SettingsPlan};

/// Bytes of a thread's stack: the deepest path of the runtime, interrupts' frames, and room for a
/// user's transform that calls a mathematical function.
const STACK_BYTES: u32 = 768;

/// The firmware of one board.
#[derive(Clone, Debug)]
pub(super) struct BoardPlan {
    pub(super) name: String,
    pub(super) tree: TreePlan,
    pub(super) settings: SettingsPlan,
    pub(super) schema: SchemaPlan,
    pub(super) pads: Vec<PadPlan>,
    pub(super) sections: Vec<Section>,
    pub(super) tasks: Vec<TaskPlan>,
    pub(super) link: LinkPlan,
    pub(super) button: Option<ButtonPlan>,
    pub(super) report_ms: u32,
    pub(super) finish_ms: u32,
    pub(super) guards: Vec<GuardPlan>,
}

/// One thread.
#[derive(Clone, Debug)]
pub(super) struct TaskPlan {
    pub(super) index: usize,
    /// `ADC1 60 ms +2`
    pub(super) name: String,
    /// The runtime's function and the table it works on.
    pub(super) function: &'static str,
    pub(super) work: String,
    pub(super) delay_ms: u32,
    pub(super) prio: i8,
    pub(super) start_ms: u32,
    pub(super) stack_bytes: u32,
}

/// Decides the firmware of a board. What the hardware or the system cannot do goes to the diagnostics.
pub(super) fn plan(context: &Context<'_>, diagnostics: &mut Vec<Diagnostic>) -> Option<BoardPlan> {
    let mut pads = Vec::new();
    let link = link::plan(context, &mut pads, diagnostics)?;
    let sections = section::sections(context, diagnostics);
    pads.extend(sections.iter().flat_map(|section| section.pads.iter().cloned()));
    pads.sort();
    pads.dedup();
    let work = sections.iter().flat_map(|section| &section.work);
    let tasks: Vec<TaskPlan> = work.enumerate().map(TaskPlan::new).collect();
    let settings = settings::plan(context, &sections, &link);
    Some(BoardPlan {
        name: context.job.board.name.value.clone(),
        tree: board::plan(context),
        schema: SchemaPlan::new(context),
        report_ms: link::report_ms(context, &tasks),
        finish_ms: link::finish_ms(context, &link),
        button: link::button(context),
        guards: settings::guards(context, &sections, &settings),
        settings,
        pads,
        sections,
        tasks,
        link,
    })
}

impl BoardPlan {
    /// The sizes that drivers want the runtime to be compiled with.
    pub(super) fn sizes(&self) -> impl Iterator<Item = &Size> {
        self.sections.iter().flat_map(|section| &section.sizes)
    }

    /// The tables that the runtime is told.
    pub(super) fn arrays(&self) -> impl Iterator<Item = &'static str> {
        self.sections.iter().flat_map(|section| section.arrays.iter().copied())
    }
}

impl TaskPlan {
    fn new((index, work): (usize, &Work)) -> Self {
        Self {
            index,
            name: work.cycle.title(&work.unit),
            function: work.function,
            work: work.table.clone(),
            delay_ms: work.cycle.delay_ms,
            prio: work.cycle.prio,
            start_ms: work.cycle.start_ms,
            stack_bytes: STACK_BYTES,
        }
    }
}
