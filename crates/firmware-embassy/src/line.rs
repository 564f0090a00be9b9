//! Lines on which the board speaks with parts: a task that asks and tells, one that sends, and an interrupt that hears.
//!
//! In: a dialogue of the job. Out: the port, its queues, the tables of its parts, and what the host sets.

use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::kind::Role;
use sensedsl_model::kind::uart::{Duplex, Parity, Uart};

use super::context::Context;
use super::hal::contract::buses::{self, Half, Hearing, PortPins, Serial};
use super::hal::contract::outputs::{Pins, Speed};
use super::item::{Handler, Item, Task, beat};
use super::missing::{self, Missing, Printed};
use super::section::{Constructor, Field, Section, Start, Watched};
use super::{filter, message};
use sensedsl_job::JobConnection;
use sensedsl_job::kinds::serial::{self, Dialogue, QUEUE_BYTES};
use sensedsl_job::part::{ComposePlan, MessagePlan};

/// A line with what prints it.
struct Line<'a> {
    context: &'a Context<'a>,
    driver: &'a dyn Serial,
    pins: &'a dyn Pins,
    dialogue: &'a Dialogue<'a>,
    plans: Vec<(&'a JobConnection<'a>, &'a MessagePlan)>,
    ident: String,
}

/// Adds a line.
pub(super) fn add(
    context: &Context<'_>,
    (driver, pins): (&dyn Serial, &dyn Pins),
    dialogue: &Dialogue<'_>,
    section: &mut Section,
    diagnostics: &mut Vec<Diagnostic>,
) -> Printed<()> {
    let uart = dialogue.uart;
    if let (Some(first), true) = (dialogue.wires.first(), uart.is_inverted && !driver.can_invert())
    {
        diagnostics.push(serial::not_inverted(first.part, context.profile));
        return Ok(());
    }
    let mut plans = Vec::new();
    for wire in &dialogue.wires {
        let plan = context.job.tables_of(wire).and_then(|plan| plan.message.as_ref());
        plans.push((*wire, plan.ok_or_else(|| Missing::table("messages"))?));
    }
    let ident = dialogue.ident();
    let line = Line { context, driver, pins, dialogue, plans, ident };
    for (_, plan) in &line.plans {
        section.tables.extend(message::tables(context, plan)?);
    }
    line.wiring(section)?;
    line.parts(section)?;
    line.say(section);
    line.hear(section)?;
    line.listen(section)
}

impl<'a> Line<'a> {
    fn upper(&self) -> String {
        self.ident.to_uppercase()
    }

    fn uart(&self) -> &'a Uart {
        self.dialogue.uart
    }

    fn first(&self) -> Printed<&'a JobConnection<'a>> {
        self.dialogue.wires.first().copied().ok_or_else(|| Missing::table("parts"))
    }

    fn duplex(&self) -> Duplex {
        self.uart().exchange.duplex
    }

    /// The port, split in its directions, and the wire for the direction.
    fn wiring(&self, section: &mut Section) -> Printed<()> {
        let first = self.first()?;
        let tx = missing::pad(first, Role::Tx)?;
        let pins = match self.duplex() {
            Duplex::Half => PortPins::Tx(tx),
            Duplex::Full | Duplex::Joined | Duplex::Direction => {
                PortPins::Both { rx: missing::pad(first, Role::Rx)?, tx }
            }
        };
        let port = buses::Port { unit: self.dialogue.unit, uart: self.uart(), pins };
        let make = self.driver.port(self.context, &port, section);
        let made = Constructor { type_: self.driver.half_type(Half::Both), make };
        let ident = &self.ident;
        section.fields.push(Field::of(ident.clone(), first.place(), made));
        section
            .starts
            .push(Start::Make(format!("let ({ident}_tx, {ident}_rx) = wiring.{ident}.split();")));
        if self.duplex() == Duplex::Direction {
            let pin = &missing::pad(first, Role::Direction)?.pin.name;
            section.fields.push(Field {
                name: format!("{ident}_direction"),
                comment: format!("{}: high while the board sends", first.place()),
                type_: "Output<'static>".to_owned(),
                make: self.pins.output(pin, "Level::Low", Speed::Medium),
            });
        }
        Ok(())
    }

    /// The tables of the parts, and what the host sets.
    fn parts(&self, section: &mut Section) -> Printed<()> {
        let upper = self.upper();
        let wake = format!("static {upper}_WAKE: rt::line::Wake = rt::line::Wake::new();");
        section.items.push(Item::Line(wake));
        let mut stations = String::new();
        for (wire, plan) in &self.plans {
            let mut orders = String::new();
            for command in &plan.commands {
                orders.push_str(&self.order(command, section)?);
            }
            let prefix = plan.prefix.to_uppercase();
            let listed = |name: &str, is_there: bool| {
                if is_there { format!("tables::{prefix}_{name}") } else { "&[]".to_owned() }
            };
            stations.push_str(&format!(
                "rt::line::Station {{ init: {}, exchanges: {}, orders: &[{orders}], cycle_ms: {} }}, ",
                listed("INIT", !plan.init.is_empty()),
                listed("EXCHANGES", !plan.exchanges.is_empty()),
                wire.cycle.delay_ms
            ));
        }
        let doc = "The parts of the line".to_owned();
        let count = self.plans.len();
        let line = format!("static {upper}_PARTS: [rt::line::Station; {count}] = [{stations}];");
        section.items.push(Item::Static { doc, line });
        Ok(())
    }

    /// What a part is told, and the statements that set it.
    fn order(&self, command: &ComposePlan, section: &mut Section) -> Printed<String> {
        let index = self.context.item(&command.field)?;
        let device = self.context.job.devices.get(index);
        let bytes = device.map_or(0, |one| one.device.value.value.size_bytes());
        let told = format!("{}_TOLD", device.map_or("", |one| one.ident.as_str()).to_uppercase());
        section.items.push(Item::Line(format!(
            "static {told}: rt::line::Told<{bytes}> = rt::line::Told::new();"
        )));
        let set = format!("rt::line::tell(&{told}, value, &{}_WAKE);", self.upper());
        section.sets.entry(index).or_default().push(set);
        if command.resend_ms > 0 {
            section.hushes.push(format!("rt::line::hush(&{told});"));
        }
        Ok(format!(
            "rt::line::Order {{ compose: tables::{}, item: {index}, answer: &{:?}, wait_ms: {}, resend_ms: {}, \
             told: &{told} }}, ",
            message::compose_name(self.context, command)?,
            command.answer,
            command.wait_ms,
            command.resend_ms
        ))
    }

    /// The most bytes that are sent at once.
    fn said_bytes(&self) -> usize {
        let of_plan = |plan: &MessagePlan| {
            let commands = plan.commands.iter().map(|one| usize::from(one.bytes));
            let requests = plan.exchanges.iter().map(|one| one.request.len());
            let init = plan.init.iter().map(|one| one.bytes.len());
            commands.chain(requests).chain(init).max().unwrap_or(0)
        };
        self.plans.iter().map(|(_, plan)| of_plan(plan)).max().unwrap_or(0)
    }

    fn tx_bytes(&self) -> usize {
        self.said_bytes().max(16)
    }

    /// The longest answer, with the echo before it.
    fn rx_bytes(&self) -> u32 {
        let answer = self.plans.iter().map(|(_, plan)| u32::from(plan.answer_bytes_max())).max();
        let all = answer.unwrap_or(0) + u32::try_from(self.said_bytes()).unwrap_or(0);
        all.clamp(*QUEUE_BYTES.start(), *QUEUE_BYTES.end())
    }

    /// The task that sends.
    fn say(&self, section: &mut Section) {
        let (ident, upper, queue) = (&self.ident, self.upper(), self.tx_bytes());
        section.items.push(Item::Line(format!(
            "static {upper}_TX: rt::serial::TxQueue<{queue}> = rt::serial::TxQueue::new();"
        )));
        let mut task =
            Task::new(format!("{}: what is sent", self.places()), format!("{ident}_say"));
        task.parameters.push(format!("port: {}", self.driver.half_type(Half::Tx)));
        task.before.push(format!(
            "rt::{}::transmit(port, &{upper}_TX, {}).await;",
            self.driver.module(),
            self.uart().baud
        ));
        section.items.push(Item::Task(task));
        let prio = self.dialogue.cycle.prio;
        section.starts.push(Start::Task(prio, format!("{ident}_say({ident}_tx)")));
    }

    fn places(&self) -> String {
        let names: Vec<&str> = self.dialogue.wires.iter().map(|one| one.title.as_str()).collect();
        names.join(", ")
    }

    fn mask(&self) -> &'static str {
        if self.uart().data_bits == 7 { "0x7F" } else { "0xFF" }
    }

    /// Who takes what the port receives.
    fn hear(&self, section: &mut Section) -> Printed<()> {
        let (ident, upper, queue) = (&self.ident, self.upper(), self.rx_bytes());
        let (module, mask) = (self.driver.module(), self.mask());
        section.items.push(Item::Line(format!(
            "static {upper}_RX: rt::serial::RxQueue<{queue}> = rt::serial::RxQueue::new();"
        )));
        if self.driver.hearing() == Hearing::Task {
            let title = format!("The bytes of {}", self.places());
            let mut task = Task::new(title, format!("{ident}_hear"));
            task.parameters.push(format!("port: {}", self.driver.half_type(Half::Rx)));
            task.before.push(format!("rt::{module}::receive(port, &{upper}_RX, {mask}).await;"));
            section.items.push(Item::Task(task));
            let prio = self.dialogue.cycle.prio;
            section.starts.push(Start::Task(prio, format!("{ident}_hear({ident}_rx)")));
            return Ok(());
        }
        let interrupt = self.context.interrupt(self.dialogue.unit, "GLOBAL")?;
        section.bind(interrupt, format!("crate::{upper}Rx"));
        let registers = self.driver.registers(&self.context.peripheral(self.dialogue.unit));
        section.begins.extend([
            format!("rt::{module}::listen({registers});"),
            "// Its handler is there.".to_owned(),
            format!("unsafe {{ interrupt::{interrupt}.enable() }};"),
        ]);
        section.items.push(Item::Handler(Handler {
            doc: format!("The bytes of {}", self.places()),
            name: format!("{upper}Rx"),
            named_as: "the line",
            interrupt: interrupt.to_owned(),
            calls: vec![format!("rt::{module}::on_interrupt(&{upper}_RX, {registers}, {mask});")],
        }));
        Ok(())
    }

    /// The task that asks and tells.
    fn listen(&self, section: &mut Section) -> Printed<()> {
        let (ident, upper, cycle) = (&self.ident, self.upper(), self.dialogue.cycle);
        let title = format!("{}: asked each {} ms", self.places(), cycle.delay_ms);
        let mut task = Task::in_turn(title, format!("{ident}_ask"), cycle);
        let mut arguments = Vec::new();
        if self.driver.hearing() == Hearing::Interrupt {
            task.parameters.push(format!("_port: {}", self.driver.half_type(Half::Rx)));
            arguments.push(format!("{ident}_rx"));
        }
        let has_direction = self.duplex() == Duplex::Direction;
        if has_direction {
            task.parameters.push("mut direction: Output<'static>".to_owned());
            arguments.push(format!("wiring.{ident}_direction"));
        }
        let own: Vec<usize> =
            self.dialogue.wires.iter().flat_map(|wire| wire.devices.iter().copied()).collect();
        let (filters, pass) = filter::of_items(self.context, |index| own.contains(&index), section);
        task.before = filters;
        task.before.push(self.settings());
        task.before.push(format!(
            "let mut line = rt::line::Line::<{}, {}, _, _, _>::new(wires, &{upper}_PARTS, &SCHEMA, &{upper}_WAKE);",
            self.memory_bytes(),
            self.said_bytes().max(1)
        ));
        let given = "|is_given: bool| direction.set_level(is_given.into())";
        let give = if has_direction { given } else { "|_: bool| {}" };
        let constant = format!("{upper}_ASK");
        task.cycle = vec![
            format!("let until = Instant::now() + Duration::from_millis({});", cycle.delay_ms),
            format!(
                "line.cycle(until, &mut {give}, &mut |index: usize, outcome, value: &mut [u8]| \
                 BOARD.report({pass}, index, outcome, value)).await;"
            ),
            beat(&constant),
            "Timer::at(until).await;".to_owned(),
        ];
        section.items.push(Item::Task(task));
        let call = format!("{ident}_ask({})", arguments.join(", "));
        section.starts.push(Start::Task(cycle.prio, call));
        section.watched.push(Watched::new(constant, cycle, self.context.id_of(self.first()?)));
        Ok(())
    }

    fn settings(&self) -> String {
        let (upper, duplex) = (self.upper(), self.duplex());
        format!(
            "let wires = rt::line::Wires {{ rx: &{upper}_RX, tx: &{upper}_TX, character_us: {}, has_echo: {}, \
             has_direction: {} }};",
            character_us(self.uart()),
            duplex.has_echo(),
            duplex == Duplex::Direction
        )
    }

    /// The longest answer, and the longest value.
    fn memory_bytes(&self) -> usize {
        let answers = self.plans.iter().map(|(_, plan)| usize::from(plan.answer_bytes_max()));
        let values = self.context.job.devices.iter().map(|one| one.device.value.value.size_bytes());
        answers.max().unwrap_or(0) + values.max().unwrap_or(0)
    }
}

/// The time of one character, rounded up.
fn character_us(uart: &Uart) -> u32 {
    let parity = u32::from(uart.parity != Parity::None);
    let bits = 1 + u32::from(uart.data_bits) + parity + u32::from(uart.stop_bits);
    (bits * 1_000_000).div_ceil(uart.baud.max(1))
}
