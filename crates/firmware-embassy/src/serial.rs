//! Serial devices: a task for each port that listens, and another one where something is sent.

use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::kind::uart::Uart;
use sensedsl_model::kind::{KindName, Role};

use super::context::Context;
use super::hal::contract::Drivers;
use super::hal::contract::buses::{self, Half, Hearing, PortPins, Serial};
use super::item::{Handler, Item, Task, beat};
use super::missing::{self, Missing, Printed};
use super::section::{Constructor, Field, Section, Start, Watched};
use super::{filter, line, message};
use sensedsl_job::JobConnection;
use sensedsl_job::kinds::serial::{self, QUEUE_BYTES};
use sensedsl_job::part::MessagePlan;

/// A port with its device.
struct Port<'a> {
    context: &'a Context<'a>,
    driver: &'a dyn Serial,
    wire: &'a JobConnection<'a>,
    unit: &'a str,
    uart: &'a Uart,
    plan: &'a MessagePlan,
    /// The static that has what is to be sent; `None` if nothing is sent.
    tx_queue: Option<String>,
}

pub(super) fn plan(
    context: &Context<'_>,
    drivers: &dyn Drivers,
    diagnostics: &mut Vec<Diagnostic>,
) -> Section {
    let mut section = Section::default();
    let Some(driver) = drivers.serial() else { return section };
    for dialogue in serial::dialogues(context.job) {
        let Some(first) = dialogue.wires.first() else { continue };
        let made =
            line::add(context, (driver, drivers.pins()), &dialogue, &mut section, diagnostics);
        context.report(first.part, made, diagnostics);
    }
    for wire in context.connections(KindName::Uart) {
        if serial::is_dialogue(context.job, wire) {
            continue;
        }
        let made = port(context, driver, wire, &mut section, diagnostics);
        context.report(wire.part, made, diagnostics);
    }
    section
}

/// A port with its tasks.
fn port(
    context: &Context<'_>,
    driver: &dyn Serial,
    wire: &JobConnection<'_>,
    section: &mut Section,
    diagnostics: &mut Vec<Diagnostic>,
) -> Printed<()> {
    let (unit, uart) = (missing::unit(wire)?, missing::kind(wire.connection.kind.uart())?);
    let plan = context.job.tables_of(wire).and_then(|plan| plan.message.as_ref());
    let plan = plan.ok_or_else(|| Missing::table("messages"))?;
    if uart.is_inverted && !driver.can_invert() {
        diagnostics.push(serial::not_inverted(wire.part, context.profile));
        return Ok(());
    }
    if !plan.fields.is_empty() {
        missing::pad(wire, Role::Rx)?;
    }
    if !plan.commands.is_empty() {
        missing::pad(wire, Role::Tx)?;
    }
    let says = wire.pad(Role::Tx).is_some() && !(plan.init.is_empty() && plan.commands.is_empty());
    let tx_queue = says.then(|| format!("{}_TX", wire.ident.to_uppercase()));
    let port = Port { context, driver, wire, unit, uart, plan, tx_queue };
    section.tables.extend(message::tables(context, plan)?);
    port.wiring(section)?;
    port.say(section)?;
    if !plan.fields.is_empty() || !plan.init.is_empty() {
        port.listen(section)?;
    }
    Ok(())
}

impl<'a> Port<'a> {
    /// What the port's statics begin with.
    fn upper(&self) -> String {
        self.wire.ident.to_uppercase()
    }

    /// The pins; the HAL has them in one object, or in one for each direction.
    fn pins(&self) -> Printed<PortPins<'a>> {
        match (self.wire.pad(Role::Rx), self.wire.pad(Role::Tx)) {
            (Some(rx), Some(tx)) => Ok(PortPins::Both { rx, tx }),
            (Some(rx), None) => Ok(PortPins::Rx(rx)),
            (None, Some(tx)) => Ok(PortPins::Tx(tx)),
            (None, None) => Err(Missing::wire("a pin for `rx` or `tx`".to_owned())),
        }
    }

    /// The driver of the port.
    fn wiring(&self, section: &mut Section) -> Printed<()> {
        let pins = self.pins()?;
        let half = match pins {
            PortPins::Both { .. } => Half::Both,
            PortPins::Rx(_) => Half::Rx,
            PortPins::Tx(_) => Half::Tx,
        };
        let port = buses::Port { unit: self.unit, uart: self.uart, pins };
        let make = self.driver.port(self.context, &port, section);
        let made = Constructor { type_: self.driver.half_type(half), make };
        section.fields.push(Field::of(self.wire.ident.clone(), self.wire.place(), made));
        // A task that has a half keeps its pin. If nothing is sent, the listening task has both halves.
        let ident = &self.wire.ident;
        if self.is_split() {
            section.starts.push(Start::Make(format!(
                "let ({ident}_tx, {ident}_rx) = wiring.{ident}.split();"
            )));
        }
        Ok(())
    }

    /// Whether different tasks have the directions.
    fn is_split(&self) -> bool {
        self.tx_queue.is_some() && self.hears() && self.wire.pad(Role::Tx).is_some()
    }

    /// Whether anything is taken of what the device sends.
    fn hears(&self) -> bool {
        !self.plan.fields.is_empty() && self.wire.pad(Role::Rx).is_some()
    }

    /// The half of the port that a task has, and where it is.
    fn half(&self, is_rx: bool) -> (Half, String) {
        let ident = &self.wire.ident;
        let both = self.wire.pad(Role::Rx).is_some() && self.wire.pad(Role::Tx).is_some();
        let half = match (both && !self.is_split(), is_rx) {
            (true, _) => Half::Both,
            (false, true) => Half::Rx,
            (false, false) => Half::Tx,
        };
        let place = match (self.is_split(), is_rx) {
            (true, true) => format!("{ident}_rx"),
            (true, false) => format!("{ident}_tx"),
            (false, _) => format!("wiring.{ident}"),
        };
        (half, place)
    }

    /// What is sent, and the task that does it.
    fn say(&self, section: &mut Section) -> Printed<()> {
        let Some(tx_queue) = &self.tx_queue else { return Ok(()) };
        let ident = &self.wire.ident;
        let (half, place) = self.half(false);
        let port = if half == Half::Tx { "port" } else { "port.split().0" };
        let longest = self.plan.commands.iter().map(|one| u32::from(one.bytes)).max().unwrap_or(0);
        let told = self.plan.init.iter().map(|one| one.bytes.len()).max().unwrap_or(0);
        let queue = (2 * longest).max(u32::try_from(told).unwrap_or(0)).max(16);
        section.items.push(Item::Line(format!(
            "static {tx_queue}: rt::serial::TxQueue<{queue}> = rt::serial::TxQueue::new();"
        )));
        let doc = format!("{}: what it is sent", self.wire.place());
        let mut task = Task::new(doc, format!("{ident}_say"));
        task.parameters.push(format!("port: {}", self.driver.half_type(half)));
        task.before.push(format!(
            "rt::{}::transmit({port}, &{tx_queue}, {}).await;",
            self.driver.module(),
            self.uart.baud
        ));
        section.items.push(Item::Task(task));
        let prio = self.wire.cycle.prio;
        section.starts.push(Start::Task(prio, format!("{ident}_say({place})")));
        for command in &self.plan.commands {
            let index = self.context.item(&command.field)?;
            section.sets.entry(index).or_default().push(format!(
                "rt::serial::send(&{tx_queue}, &tables::{}, &SCHEMA, {index}, value, &mut [0; {}], &BOARD);",
                message::compose_name(self.context, command)?,
                command.bytes
            ));
        }
        Ok(())
    }

    /// The interrupt of the port, and the task that takes what it has received.
    fn listen(&self, section: &mut Section) -> Printed<()> {
        let (ident, upper, cycle) = (&self.wire.ident, self.upper(), self.wire.cycle);
        let has_fields = self.hears();
        let (half, place) = self.half(true);
        let title = format!("{}: what it says, each {} ms", self.wire.place(), cycle.delay_ms);
        let mut task = Task::in_turn(title, format!("{ident}_listen"), cycle);
        let mut call = String::new();
        if has_fields {
            match self.driver.hearing() {
                Hearing::Interrupt => {
                    self.interrupt(section)?;
                    task.parameters.push(format!("_port: {}", self.driver.half_type(half)));
                    call.clone_from(&place);
                }
                Hearing::Task => self.hear((half, &place), section),
            }
        }
        let is_own = |index: usize| self.wire.devices.contains(&index);
        let (filters, pass) = filter::of_items(self.context, is_own, section);
        task.before = filters;
        if !self.plan.init.is_empty() {
            task.before.push("let mut start = sense_rt::MessageStart::NEW;".to_owned());
        }
        if has_fields {
            task.before.extend(self.device()?);
        }
        let constant = format!("{upper}_LISTEN");
        let until =
            format!("let until = Instant::now() + Duration::from_millis({});", cycle.delay_ms);
        task.cycle.push(until);
        task.cycle.extend(self.cycle(has_fields, &pass));
        task.cycle.push(beat(&constant));
        task.cycle.push("Timer::at(until).await;".to_owned());
        section.items.push(Item::Task(task));
        section.starts.push(Start::Task(cycle.prio, format!("{ident}_listen({call})")));
        section.watched.push(Watched::new(constant, cycle, self.context.id_of(self.wire)));
        Ok(())
    }

    /// The queue of what the port receives.
    fn queue(&self) -> Item {
        let queue = serial::waiting_bytes(self.uart);
        let queue = queue.clamp(*QUEUE_BYTES.start(), *QUEUE_BYTES.end());
        Item::Line(format!(
            "static {}_RX: rt::serial::RxQueue<{queue}> = rt::serial::RxQueue::new();",
            self.upper()
        ))
    }

    /// The bits of a character that are data.
    fn mask(&self) -> &'static str {
        if self.uart.data_bits == 7 { "0x7F" } else { "0xFF" }
    }

    /// The task that takes what the port receives, and what it fills.
    fn hear(&self, (half, place): (Half, &str), section: &mut Section) {
        let (ident, upper) = (&self.wire.ident, self.upper());
        let port = if half == Half::Rx { "port" } else { "port.split().1" };
        let mut task =
            Task::new(format!("The bytes of {}", self.wire.place()), format!("{ident}_hear"));
        task.parameters.push(format!("port: {}", self.driver.half_type(half)));
        task.before.push(format!(
            "rt::{}::receive({port}, &{upper}_RX, {}).await;",
            self.driver.module(),
            self.mask()
        ));
        section.items.extend([self.queue(), Item::Task(task)]);
        section.starts.push(Start::Task(self.wire.cycle.prio, format!("{ident}_hear({place})")));
    }

    /// The handler of the port's interrupt, and what it fills.
    fn interrupt(&self, section: &mut Section) -> Printed<()> {
        let upper = self.upper();
        let interrupt = self.context.interrupt(self.unit, "GLOBAL")?;
        section.bind(interrupt, format!("crate::{upper}Rx"));
        let registers = self.driver.registers(&self.context.peripheral(self.unit));
        let mask = self.mask();
        let module = self.driver.module();
        section.begins.extend([
            format!("rt::{module}::listen({registers});"),
            "// Its handler is there.".to_owned(),
            format!("unsafe {{ interrupt::{interrupt}.enable() }};"),
        ]);
        section.items.push(self.queue());
        section.items.push(Item::Handler(Handler {
            doc: format!("The bytes of {}", self.wire.place()),
            name: format!("{upper}Rx"),
            named_as: "the device",
            interrupt: interrupt.to_owned(),
            calls: vec![format!("rt::{module}::on_interrupt(&{upper}_RX, {registers}, {mask});")],
        }));
        Ok(())
    }

    /// The variables of the task for a device that sends something.
    fn device(&self) -> Printed<Vec<String>> {
        let (upper, prefix) = (self.upper(), self.plan.prefix.to_uppercase());
        let own = self.plan.fields.iter().map(|one| self.context.item(&one.field));
        let own = own.collect::<Printed<Vec<_>>>()?;
        let gap_ms = serial::gap_ms(self.uart, self.plan);
        Ok(vec![
            format!(
                "let mut stream: sense_rt::MessageStream<[u8; tables::{prefix}_MESSAGE.stream_bytes(&SCHEMA)]> = \
                 sense_rt::MessageStream::new(&tables::{prefix}_MESSAGE, &SCHEMA);"
            ),
            format!(
                "let mut device = rt::serial::Device::new(&{upper}_RX, &mut stream, {gap_ms}, &{own:?});"
            ),
        ])
    }

    /// What the task does in a cycle. It reports the first value of a cycle, as that is when one is due, and all
    /// faults.
    fn cycle(&self, has_fields: bool, pass: &str) -> Vec<String> {
        let mut statements = Vec::new();
        if let (Some(tx_queue), false) = (&self.tx_queue, self.plan.init.is_empty()) {
            if has_fields {
                statements.push(format!(
                    "if device.is_forgotten({}) {{ start = sense_rt::MessageStart::NEW; }}",
                    self.wire.cycle.delay_ms
                ));
            }
            statements.push(format!(
                "rt::serial::set_up(&{tx_queue}, &mut start, tables::{}_INIT).await;",
                self.plan.prefix.to_uppercase()
            ));
        }
        if has_fields {
            statements.push(format!(
                "device.cycle(until, |index: usize, outcome, value: &mut [u8]| \
                 BOARD.report({pass}, index, outcome, value)).await;"
            ));
        }
        statements
    }
}
