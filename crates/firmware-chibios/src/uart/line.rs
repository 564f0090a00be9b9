//! Lines on which the board speaks with parts: their settings, and what each part is asked and told.

use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::kind::Role;
use sensedsl_model::kind::uart::{Duplex, Parity, Uart};

use super::v1::{cr1, cr2, frame, not_inverted};
use crate::context::{Context, Drive};
use crate::section::{Apply, Failsafe, Section, Work};
use crate::stacks::Depth;
use sensedsl_board::signal::UnitName;
use sensedsl_files::{block, templates};
use sensedsl_job::kinds::serial::{self, Dialogue, QUEUE_BYTES};
use sensedsl_job::part::{ComposePlan, MessagePlan};
use sensedsl_job::{Cycle, JobConnection};

/// The stack depth of its thread, without the message that is put together.
const DEPTH: Depth = Depth { plain: [700, 620], filtered: [800, 640] };

templates! {
    s: Lines;
    Tables = "uart/line.c.txt";
}

/// What the lines of a board come to.
#[derive(Default)]
pub(super) struct Added {
    /// The C code of their tables.
    pub(super) tables: String,
    /// The queue that their ports need; 0 without a line.
    pub(super) queue_bytes: u32,
    /// The longest message that is sent on one.
    pub(super) send_bytes: u32,
}

struct Lines {
    lines: Vec<Line>,
}

/// A port with its line.
struct Line {
    ident: String,
    /// Its parts, for people.
    place: String,
    driver: String,
    baud: u32,
    frame: String,
    cr1: String,
    cr2: String,
    /// The settings of its third register; empty for none.
    cr3: &'static str,
    parts: Vec<Station>,
    answer_bytes: u16,
    scratch_words: usize,
    direction: Option<String>,
    has_echo: bool,
    character_us: u32,
    cycle: Cycle,
}

/// A part on a line.
struct Station {
    ident: String,
    prefix: String,
    init: usize,
    exchanges: usize,
    orders: Vec<Order>,
    cycle_ms: u32,
}

/// A value that a part is told.
struct Order {
    field: String,
    answer: usize,
    wait_ms: u16,
    resend_ms: u32,
    words: usize,
}

/// Adds the lines to the section of the serial ports.
pub(super) fn add(
    context: &Context<'_>,
    section: &mut Section,
    diagnostics: &mut Vec<Diagnostic>,
) -> Added {
    let mut added = Added { send_bytes: 1, ..Added::default() };
    let mut lines = Vec::new();
    for dialogue in serial::dialogues(context.job) {
        let Some(line) = Line::new(context, &dialogue) else { continue };
        if let Some(first) = dialogue.wires.first() {
            diagnostics.extend(not_inverted(context, first, dialogue.uart));
            pads(context, first, dialogue.uart, section, diagnostics);
        }
        let plans = || dialogue.wires.iter().filter_map(|wire| message(context, wire));
        let sent = plans().map(sent_bytes).max().unwrap_or(0);
        let said = plans().map(|plan| said_bytes(plan).max(sent)).max().unwrap_or(0);
        let heard = said + u32::from(line.answer_bytes);
        added.send_bytes = added.send_bytes.max(sent);
        let needed = heard.clamp(*QUEUE_BYTES.start(), *QUEUE_BYTES.end());
        added.queue_bytes = added.queue_bytes.max(needed);
        section.units.insert(UnitName::new(dialogue.unit));
        let clock = context.profile.unit(dialogue.unit).and_then(|unit| unit.clock.clone());
        section.clocks.extend(clock);
        section.starts.push(format!("up_line_start(&{}_line);", line.ident));
        if line.parts.iter().flat_map(|part| &part.orders).any(|order| order.resend_ms > 0) {
            section.failsafes.push(Failsafe {
                field: None,
                line: format!("up_line_hush(&{}_line);", line.ident),
            });
        }
        section.applies.extend(line.applies());
        section.work.push(line.work(context, &dialogue));
        lines.push(line);
    }
    if !lines.is_empty() {
        added.tables = block(&Tables { s: &Lines { lines } });
    }
    added
}

fn message<'a>(context: &Context<'a>, wire: &JobConnection<'a>) -> Option<&'a MessagePlan> {
    let parts = context.job.parts.iter();
    parts.filter(|one| one.index == wire.connection.part).find_map(|one| one.plan.message.as_ref())
}

/// The longest command of a part.
fn sent_bytes(plan: &MessagePlan) -> u32 {
    plan.commands.iter().map(|one| u32::from(one.bytes)).max().unwrap_or(0)
}

/// The longest of what is sent to a part besides commands.
fn said_bytes(plan: &MessagePlan) -> u32 {
    let init = plan.init.iter().map(|one| one.bytes.len());
    let all = init.chain(plan.exchanges.iter().map(|one| one.request.len()));
    u32::try_from(all.max().unwrap_or(0)).unwrap_or(u32::MAX)
}

/// The pads of a line, which all its parts share.
fn pads(
    context: &Context<'_>,
    first: &JobConnection<'_>,
    uart: &Uart,
    section: &mut Section,
    diagnostics: &mut Vec<Diagnostic>,
) {
    for pad in &first.pads {
        let drive = match (pad.role, uart.exchange.duplex) {
            (Role::Direction, _) => {
                section.pads.extend(context.pad(pad, "PAL_MODE_OUTPUT_PUSHPULL", diagnostics));
                continue;
            }
            // Each end of the wire pulls it low, or lets it go.
            (_, Duplex::Half) => Drive::OpenDrain,
            (Role::Rx, _) => Drive::Resting(!uart.is_inverted),
            (_, _) => Drive::Plain,
        };
        section.pads.extend(context.alternate_pad(pad, drive, diagnostics));
    }
}

impl Line {
    fn new(context: &Context<'_>, dialogue: &Dialogue<'_>) -> Option<Self> {
        let uart = dialogue.uart;
        let first = dialogue.wires.first()?;
        let places: Vec<&str> = dialogue.wires.iter().map(|one| one.title.as_str()).collect();
        let plans: Vec<&MessagePlan> =
            dialogue.wires.iter().filter_map(|wire| message(context, wire)).collect();
        let parts = dialogue.wires.iter().filter_map(|wire| station(context, wire));
        let direction = first.pad(Role::Direction).and_then(|pad| context.line(&pad.pin.name));
        Some(Self {
            ident: dialogue.ident(),
            place: places.join(", "),
            driver: context.names.driver(dialogue.unit)?,
            baud: uart.baud,
            frame: frame(uart),
            cr1: cr1(uart),
            cr2: cr2(uart),
            cr3: if uart.exchange.duplex == Duplex::Half { "USART_CR3_HDSEL" } else { "" },
            parts: parts.collect(),
            answer_bytes: plans.iter().map(|plan| plan.answer_bytes_max()).max().unwrap_or(0),
            scratch_words: plans.iter().map(|plan| plan.scratch_words).max().unwrap_or(1),
            direction,
            has_echo: uart.exchange.duplex.has_echo(),
            character_us: character_us(uart),
            cycle: dialogue.cycle,
        })
    }

    fn applies(&self) -> Vec<Apply> {
        let orders = self.parts.iter().flat_map(|part| {
            part.orders.iter().enumerate().map(move |(at, order)| (part, at, order))
        });
        let apply = |(part, at, order): (&Station, usize, &Order)| Apply {
            field: order.field.clone(),
            line: format!(
                "up_line_tell(&{}_line, &{}_orders[{at}], value);",
                self.ident, part.ident
            ),
        };
        orders.map(apply).collect()
    }

    fn work(&self, context: &Context<'_>, dialogue: &Dialogue<'_>) -> Work {
        Work {
            unit: dialogue.unit.to_owned(),
            cycle: self.cycle,
            function: "up_line_cycle",
            table: format!("{}_line", self.ident),
            device: dialogue.wires.first().map_or(0, |wire| context.id_of(wire)),
            depth: DEPTH,
        }
    }
}

fn station(context: &Context<'_>, wire: &JobConnection<'_>) -> Option<Station> {
    let plan = message(context, wire)?;
    let order = |one: &ComposePlan| {
        let device = context.job.devices.iter().find(|device| device.name() == one.field)?;
        Some(Order {
            field: one.field.clone(),
            answer: one.answer.len(),
            wait_ms: one.wait_ms,
            resend_ms: one.resend_ms,
            words: device.device.value.value.size_bytes().div_ceil(8).max(1),
        })
    };
    Some(Station {
        ident: wire.ident.clone(),
        prefix: plan.prefix.clone(),
        init: plan.init.len(),
        exchanges: plan.exchanges.len(),
        orders: plan.commands.iter().filter_map(order).collect(),
        cycle_ms: wire.cycle.delay_ms,
    })
}

/// The time of one character, rounded up.
fn character_us(uart: &Uart) -> u32 {
    let parity = u32::from(uart.parity != Parity::None);
    let bits = 1 + u32::from(uart.data_bits) + parity + u32::from(uart.stop_bits);
    (bits * 1_000_000).div_ceil(uart.baud.max(1))
}
