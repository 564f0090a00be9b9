//! All decisions about a sketch, ready to be printed.

use sensedsl_diagnostics::Diagnostic;
use sensedsl_diagnostics::codes::{e0501_no_generator, e0504_no_firmware_target};
use sensedsl_firmware_c::runtime::File;
use sensedsl_firmware_c::{self as c, FallBackPlan, Role, SchemaPlan, Wiring};
use sensedsl_job::part::uses_in_c;
use sensedsl_job::{BoardJob, JobDevice, Owner};
use sensedsl_model::design::Transport;
use sensedsl_wire::ScalarType;

use crate::changes::Handlers;
use crate::context::Context;
use crate::control::{self, ControlPlan};
use crate::memory::{Memory, Sizes};
use crate::names::BoardNames;
use crate::section::{Apply, PortPlan, Section, Work};
use crate::{bus, peripherals, runtime};

/// The reporter's cycle if nothing is read more often.
const REPORT_MS: u32 = 10;
/// What the framework's ports accept at once: their buffers, one byte of which stays free.
const UART_ROOM_BYTES: u32 = 63;
const USB_ROOM_BYTES: u32 = 64;

/// The sketch of one board.
#[derive(Clone, Debug)]
pub(crate) struct SketchPlan {
    pub(crate) name: String,
    pub(crate) mcu: String,
    pub(crate) board: BoardNames,
    pub(crate) schema: SchemaPlan,
    /// Settings of `sense_conf.h` that are 0 or a number.
    pub(crate) settings: Vec<(String, u32)>,
    pub(crate) parts: Vec<String>,
    /// The filter of each field; empty if none has one.
    pub(crate) filters: Vec<Option<String>>,
    pub(crate) sections: Vec<Section>,
    pub(crate) files: Vec<File>,
    pub(crate) handlers: Handlers,
    pub(crate) tasks: Vec<Work>,
    pub(crate) cycles_ms: Vec<u32>,
    pub(crate) fall_backs: Vec<FallBackPlan>,
    pub(crate) controllers: ControlPlan,
    pub(crate) link: LinkPlan,
    pub(crate) report_ms: u32,
    pub(crate) work_bytes: usize,
    pub(crate) memory: Memory,
    pub(crate) ram_bytes: u32,
    pub(crate) flash_bytes: u32,
}

/// The port of the link.
#[derive(Clone, Debug)]
pub(crate) struct LinkPlan {
    pub(crate) object: String,
    /// 0 over USB.
    pub(crate) baud: u32,
    pub(crate) is_usb: bool,
}

/// Decides the sketch of a board. What the hardware cannot do is reported.
pub(crate) fn plan(context: &Context<'_>, diagnostics: &mut Vec<Diagnostic>) -> Option<SketchPlan> {
    let job = context.job;
    diagnostics.extend(wide(job));
    let link = link(context, diagnostics)?;
    let (mut sections, mut files) = peripherals::sections(context, diagnostics);
    let controllers = ControlPlan::new(job);
    if !controllers.is_empty() {
        sections.push(control::section(context, &controllers));
        files.extend(runtime::CONTROL);
    }
    let schema = SchemaPlan::new(&job.schema, Role::Board);
    let tasks: Vec<Work> = sections.iter().flat_map(|section| section.work.clone()).collect();
    let report_ms = report_ms(job, &tasks);
    let buses = job.parts.iter().flat_map(|part| &part.plan.buses);
    let work_bytes = buses.map(|plan| plan.work_bytes).max().unwrap_or(0);
    let handlers = Handlers::new(context, sections.iter().flat_map(|section| &section.changes));
    let sizes = sizes(job, &schema, tasks.len(), work_bytes, link.is_usb);
    let memory = Memory::new(context, &sizes, sections.iter().flat_map(|section| &section.costs));
    diagnostics.extend(memory.report(context));
    let filters = filters(job);
    let mut plan = SketchPlan {
        name: job.board.name.value.clone(),
        mcu: context.names.mcu.clone(),
        board: context.names.board.clone(),
        settings: Vec::new(),
        parts: job.parts.iter().map(|one| tables(job, one)).collect(),
        filters,
        files,
        handlers,
        cycles_ms: job.cycles_ms(),
        fall_backs: fall_backs(job),
        controllers,
        report_ms,
        work_bytes,
        memory,
        ram_bytes: context.names.ram_bytes,
        flash_bytes: context.names.flash_bytes,
        schema,
        sections,
        tasks,
        link,
    };
    plan.settings = plan.settings(job);
    Some(plan)
}

/// Values of 64-bit floats, which the compiler for AVR makes as short as those of 32.
fn wide(job: &BoardJob<'_>) -> Vec<Diagnostic> {
    let is_wide = |one: &&JobDevice<'_>| one.device.value.value.scalar == ScalarType::Float64;
    let report = |one: &JobDevice<'_>| {
        let name = &one.device.name;
        e0501_no_generator::not_made_yet(name.span, &name.value, "values of float64 on an AVR")
    };
    job.devices.iter().filter(is_wide).map(report).collect()
}

fn link(context: &Context<'_>, diagnostics: &mut Vec<Diagnostic>) -> Option<LinkPlan> {
    let link = &context.job.board.link;
    let made = match link.transport {
        Transport::Usb => Some(LinkPlan { object: "Serial".to_owned(), baud: 0, is_usb: true }),
        Transport::Uart => context.job.link.as_ref().and_then(|port| {
            let object = context.names.object(port.unit)?.to_owned();
            Some(LinkPlan { object, baud: link.baud, is_usb: false })
        }),
        Transport::None => None,
    };
    if made.is_none() {
        let name = &context.job.board.name;
        let why = match link.transport {
            Transport::None => "it has no link to send reports over (`transport = none`)",
            Transport::Usb | Transport::Uart => {
                "the framework has no object for the port of its link"
            }
        };
        diagnostics.push(e0504_no_firmware_target::no_firmware_target(name.span, &name.value, why));
    }
    made
}

/// The reporter's cycle: as short as the time in which something can become due, but no shorter than the link allows.
fn report_ms(job: &BoardJob<'_>, tasks: &[Work]) -> u32 {
    if let Some(report_ms) = job.board.link.report_ms() {
        return report_ms;
    }
    tasks.iter().map(|task| task.cycle.delay_ms).fold(REPORT_MS, u32::min).max(1)
}

/// The values that are set when the host falls silent: what code sets is not the host's.
fn fall_backs(job: &BoardJob<'_>) -> Vec<FallBackPlan> {
    let hosts = job.devices.iter().enumerate();
    let hosts = hosts.filter(|(index, _)| job.owner(*index) == Owner::Host);
    hosts.filter_map(|(_, one)| FallBackPlan::new(one)).collect()
}

/// The tables of a part.
fn tables(job: &BoardJob<'_>, one: &sensedsl_job::JobPart<'_>) -> String {
    let select = bus::number_of(job, one.index);
    c::tables(&one.plan, Wiring { select, shares_memory: true, ..Wiring::default() })
}

/// The filter of each field, by the names of its tables; empty if none has one.
fn filters(job: &BoardJob<'_>) -> Vec<Option<String>> {
    let of = |one: &JobDevice<'_>| {
        let plan = &job.parts.iter().find(|part| part.index == one.device.part)?.plan;
        let has_one = plan.filters.iter().any(|filter| filter.field == one.name());
        has_one.then(|| one.ident.clone())
    };
    let all: Vec<Option<String>> = job.devices.iter().map(of).collect();
    if all.iter().any(Option::is_some) { all } else { Vec::new() }
}

fn sizes(
    job: &BoardJob<'_>,
    schema: &SchemaPlan,
    tasks: usize,
    work_bytes: usize,
    is_usb: bool,
) -> Sizes {
    let values_bytes = job.devices.iter().map(|one| one.device.value.value.size_bytes()).sum();
    let [report_frame_bytes, command_buffer_bytes] = schema.buffers_bytes();
    Sizes {
        fields: job.devices.len(),
        tasks,
        values_bytes,
        report_frame_bytes,
        command_buffer_bytes,
        received_bytes: if job.has_actuators() { values_bytes } else { 0 },
        work_bytes,
        scratch_bytes: schema.value_bytes_max.next_multiple_of(8),
        is_usb,
    }
}

impl SketchPlan {
    /// The settings that the runtime is compiled with.
    fn settings(&self, job: &BoardJob<'_>) -> Vec<(String, u32)> {
        let count = |number: usize| u32::try_from(number).unwrap_or(u32::MAX);
        let fields = self.schema.fields_count();
        let room = if self.link.is_usb { USB_ROOM_BYTES } else { UART_ROOM_BYTES };
        let mut all: Vec<(String, u32)> = [
            ("UP_FIELDS_COUNT", count(fields)),
            ("UP_FIELD_BITMAP_BYTES", count(fields.div_ceil(8).max(1))),
            ("UP_TASKS_COUNT", count(self.tasks.len())),
            ("UP_VALUE_BYTES_MAX", count(self.schema.value_bytes_max)),
            ("UP_REPORT_MS", self.report_ms),
            ("UP_SILENCE_MS", job.board.link.silence_ms.unwrap_or(0)),
            ("UP_LINK_ROOM_BYTES", room),
            ("UP_HAS_FILTERS", u32::from(!self.filters.is_empty())),
            ("UP_HAS_CONTROL", u32::from(!self.controllers.is_empty())),
        ]
        .into_iter()
        .map(|(name, number)| (name.to_owned(), number))
        .collect();
        let sizes = self.sections.iter().flat_map(|section| &section.sizes);
        all.extend(sizes.map(|(name, number)| ((*name).to_owned(), *number)));
        let unused = uses_in_c(job).into_iter().filter(|(_, is_used)| !is_used);
        let commands = (!job.has_actuators()).then_some(("commands", false));
        let name = |name: &str| format!("UP_USES_{}", name.to_uppercase().replace('-', "_"));
        all.extend(unused.chain(commands).map(|(own, _)| (name(own), 0)));
        let wires = self.schema.left_out();
        all.extend(
            wires.iter().filter_map(|option| Some((option.split_once('=')?.0.to_owned(), 0))),
        );
        all
    }

    /// The headers of the sections.
    pub(crate) fn headers(&self) -> Vec<&'static str> {
        let mut all: Vec<&str> =
            self.sections.iter().flat_map(|section| section.headers.iter().copied()).collect();
        all.sort_unstable();
        all.dedup();
        all
    }

    /// The lines that set pads up.
    pub(crate) fn pads(&self) -> Vec<&str> {
        self.lines(|section| &section.pads)
    }

    /// The lines that start what sections have.
    pub(crate) fn starts(&self) -> Vec<&str> {
        self.lines(|section| &section.starts)
    }

    /// The lines that take what interrupts have collected.
    pub(crate) fn polls(&self) -> Vec<&str> {
        self.lines(|section| &section.polls)
    }

    /// The lines that empty serial ports.
    pub(crate) fn drains(&self) -> Vec<&str> {
        self.lines(|section| &section.drains)
    }

    /// The serial ports of devices.
    pub(crate) fn ports(&self) -> Vec<&PortPlan> {
        self.sections.iter().flat_map(|section| &section.ports).collect()
    }

    /// The lines that bring the host's actuators to their failsafe state.
    pub(crate) fn failsafes(&self) -> Vec<&str> {
        let all = self.sections.iter().flat_map(|section| &section.failsafes);
        let hosts = all.filter(|one| !self.controllers.sets(&one.field));
        hosts.map(|one| one.line.as_str()).collect()
    }

    /// The lines that run when an actuator is set.
    pub(crate) fn applies(&self) -> Vec<&Apply> {
        self.sections.iter().flat_map(|section| &section.applies).collect()
    }

    fn lines(&self, of: fn(&Section) -> &Vec<String>) -> Vec<&str> {
        self.sections.iter().flat_map(of).map(String::as_str).collect()
    }
}
