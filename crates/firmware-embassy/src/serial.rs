//! Serial devices: a task for each port that listens, and one that sends where something is sent.

use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::kind::uart::{Parity, Uart};
use sensedsl_model::kind::{KindName, Role};

use super::context::Context;
use super::hal::Hal;
use super::item::{Handler, Item, Task, beat};
use super::lack::{self, Missing, Printed};
use super::section::{Field, Section, Start, Watched};
use super::{filter, message, rp};
use sensedsl_job::JobConnection;
use sensedsl_job::kinds::serial::{self, QUEUE_BYTES};
use sensedsl_job::part::MessagePlan;

/// A port with its device.
struct Port<'a> {
    wire: &'a JobConnection<'a>,
    unit: &'a str,
    uart: &'a Uart,
    plan: &'a MessagePlan,
    /// The static with what is to be sent; none where nothing is.
    said: Option<String>,
}

pub(super) fn plan(context: &Context<'_>, diagnostics: &mut Vec<Diagnostic>) -> Section {
    let mut section = Section::default();
    for wire in context.connections(KindName::Uart) {
        let made = port(context, wire, &mut section, diagnostics);
        context.tell(wire.part, made, diagnostics);
    }
    section
}

/// A port with its tasks.
fn port(
    context: &Context<'_>,
    wire: &JobConnection<'_>,
    section: &mut Section,
    diagnostics: &mut Vec<Diagnostic>,
) -> Printed<()> {
    let (unit, uart) = (lack::unit(wire)?, lack::kind(wire.connection.kind.uart())?);
    let plan = context.job.tables_of(wire).and_then(|plan| plan.message.as_ref());
    let plan = plan.ok_or_else(|| Missing::table("messages"))?;
    if uart.is_inverted && context.names.has_old_ports() {
        diagnostics.push(serial::not_inverted(wire.part, context.profile));
        return Ok(());
    }
    if !plan.fields.is_empty() {
        lack::pad(wire, Role::Rx)?;
    }
    if !plan.commands.is_empty() {
        lack::pad(wire, Role::Tx)?;
    }
    let says = wire.pad(Role::Tx).is_some() && !(plan.init.is_empty() && plan.commands.is_empty());
    let said = says.then(|| format!("{}_SAID", wire.ident.to_uppercase()));
    let port = Port { wire, unit, uart, plan, said };
    section.tables.extend(message::tables(context, plan)?);
    section.features.extend(context.names.port_feature());
    port.wiring(context, section)?;
    port.say(context, section)?;
    if !plan.fields.is_empty() || !plan.init.is_empty() {
        port.listen(context, section)?;
    }
    Ok(())
}

/// The HAL's module of serial ports, and the runtime's between them and the devices.
const fn module(hal: Hal) -> &'static str {
    match hal {
        Hal::Stm32 => "usart",
        Hal::Rp => "uart",
    }
}

/// The type of a port or a half of one.
fn port_type(hal: Hal, name: &str) -> String {
    match hal {
        Hal::Stm32 => format!("hal::usart::{name}<'static, hal::mode::Blocking>"),
        Hal::Rp => format!("hal::uart::{name}<'static, hal::uart::Blocking>"),
    }
}

impl Port<'_> {
    /// What the port's statics begin with.
    fn upper(&self) -> String {
        self.wire.ident.to_uppercase()
    }

    /// The HAL's configuration.
    fn config(&self, hal: Hal) -> String {
        let Uart { baud, data_bits, parity, stop_bits, is_inverted, .. } = self.uart;
        let parity = match parity {
            Parity::None => "ParityNone",
            Parity::Even => "ParityEven",
            Parity::Odd => "ParityOdd",
        };
        match hal {
            Hal::Stm32 => {
                let config = format!(
                    "crate::rt::usart::config({baud}, {data_bits}, hal::usart::Parity::{parity}, {stop_bits})"
                );
                if *is_inverted { format!("crate::rt::usart::inverted({config})") } else { config }
            }
            Hal::Rp => format!(
                "crate::rt::uart::config({baud}, {data_bits}, hal::uart::Parity::{parity}, {stop_bits}, {is_inverted})"
            ),
        }
    }

    /// The pins, which the HAL keeps in one object, or in one for each direction.
    fn wiring(&self, context: &Context<'_>, section: &mut Section) -> Printed<()> {
        let hal = context.peripheral(self.unit);
        let pin = |role| self.wire.pad(role).map(|pad| context.pin(&pad.pin.name));
        let config = self.config(context.names.hal);
        let moved = context.generics(self.unit, &["_"]);
        let (name, pins) = match (pin(Role::Rx), pin(Role::Tx), context.names.hal) {
            (Some(rx), Some(tx), Hal::Stm32) => ("Uart", format!("p.{rx}, p.{tx}")),
            (Some(rx), Some(tx), Hal::Rp) => ("Uart", format!("p.{tx}, p.{rx}")),
            (Some(rx), None, Hal::Stm32 | Hal::Rp) => ("UartRx", format!("p.{rx}")),
            (None, Some(tx), Hal::Stm32 | Hal::Rp) => ("UartTx", format!("p.{tx}")),
            (None, None, Hal::Stm32 | Hal::Rp) => {
                return Err(Missing::wire("a pin for `rx` or `tx`".to_owned()));
            }
        };
        if let (Some(rx), Hal::Rp) = (self.wire.pad(Role::Rx), context.names.hal) {
            rp::link::rest(context, rx, self.uart.is_inverted, section);
        }
        let module = module(context.names.hal);
        let made = format!("hal::{module}::{name}::new_blocking{moved}(p.{hal}, {pins}, {config})");
        section.fields.push(Field {
            name: self.wire.ident.clone(),
            comment: self.wire.place(),
            type_: port_type(context.names.hal, name),
            // The HAL of STM32 judges the rate.
            make: match context.names.hal {
                Hal::Stm32 => format!("crate::rt::usart::port({made})"),
                Hal::Rp => made,
            },
        });
        // A task that holds a half keeps its pin. If nothing is sent, the listening task holds both.
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
        self.said.is_some() && self.hears() && self.wire.pad(Role::Tx).is_some()
    }

    /// Whether anything that the device says is taken.
    fn hears(&self) -> bool {
        !self.plan.fields.is_empty() && self.wire.pad(Role::Rx).is_some()
    }

    /// The half of the port for a task: its type and where it is.
    fn half(&self, hal: Hal, is_rx: bool) -> (String, String) {
        let ident = &self.wire.ident;
        let both = self.wire.pad(Role::Rx).is_some() && self.wire.pad(Role::Tx).is_some();
        let name = match (both && !self.is_split(), is_rx) {
            (true, _) => "Uart",
            (false, true) => "UartRx",
            (false, false) => "UartTx",
        };
        let place = match (self.is_split(), is_rx) {
            (true, true) => format!("{ident}_rx"),
            (true, false) => format!("{ident}_tx"),
            (false, _) => format!("wiring.{ident}"),
        };
        (port_type(hal, name), place)
    }

    /// What is sent, and the task that does it.
    fn say(&self, context: &Context<'_>, section: &mut Section) -> Printed<()> {
        let Some(said) = &self.said else { return Ok(()) };
        let ident = &self.wire.ident;
        let (type_, place) = self.half(context.names.hal, false);
        let port = if type_.contains("UartTx") { "port" } else { "port.split().0" };
        let longest = self.plan.commands.iter().map(|one| u32::from(one.bytes)).max().unwrap_or(0);
        let told = self.plan.init.iter().map(|one| one.bytes.len()).max().unwrap_or(0);
        let queue = (2 * longest).max(u32::try_from(told).unwrap_or(0)).max(16);
        section.items.push(Item::Line(format!(
            "static {said}: rt::serial::TxQueue<{queue}> = rt::serial::TxQueue::new();"
        )));
        let doc = format!("{}: what it is sent", self.wire.place());
        let mut task = Task::new(doc, format!("{ident}_say"));
        task.parameters.push(format!("port: {type_}"));
        task.before.push(format!(
            "rt::{}::transmit({port}, &{said}, {}).await;",
            module(context.names.hal),
            self.uart.baud
        ));
        section.items.push(Item::Task(task));
        let prio = self.wire.cycle.prio;
        section.starts.push(Start::Task(prio, format!("{ident}_say({place})")));
        for command in &self.plan.commands {
            let index = context.item(&command.field)?;
            section.sets.entry(index).or_default().push(format!(
                "rt::serial::send(&{said}, &tables::{}, &SCHEMA, {index}, value, &mut [0; {}], &BOARD);",
                message::compose_name(context, command)?,
                command.bytes
            ));
        }
        Ok(())
    }

    /// The interrupt of the port, and the task that takes what it has heard.
    fn listen(&self, context: &Context<'_>, section: &mut Section) -> Printed<()> {
        let (ident, upper, cycle) = (&self.wire.ident, self.upper(), self.wire.cycle);
        let has_fields = self.hears();
        let (type_, place) = self.half(context.names.hal, true);
        let title = format!("{}: what it says, each {} ms", self.wire.place(), cycle.delay_ms);
        let mut task = Task::in_turn(title, format!("{ident}_listen"), cycle);
        if has_fields {
            self.interrupt(context, section)?;
            task.parameters.push(format!("_port: {type_}"));
        }
        let is_own = |index: usize| self.wire.devices.contains(&index);
        let (filters, pass) = filter::of_items(context, is_own, section);
        task.before = filters;
        if !self.plan.init.is_empty() {
            task.before.push("let mut start = sense_rt::MessageStart::NEW;".to_owned());
        }
        if has_fields {
            task.before.extend(self.device(context)?);
        }
        let constant = format!("{upper}_LISTEN");
        let until =
            format!("let until = Instant::now() + Duration::from_millis({});", cycle.delay_ms);
        task.cycle.push(until);
        task.cycle.extend(self.cycle(has_fields, &pass));
        task.cycle.push(beat(&constant));
        task.cycle.push("Timer::at(until).await;".to_owned());
        section.items.push(Item::Task(task));
        let call = if has_fields { place } else { String::new() };
        section.starts.push(Start::Task(cycle.prio, format!("{ident}_listen({call})")));
        section.watched.push(Watched::new(constant, cycle, context.id_of(self.wire)));
        Ok(())
    }

    /// The handler of the port's interrupt, and what it fills.
    fn interrupt(&self, context: &Context<'_>, section: &mut Section) -> Printed<()> {
        let (upper, hal) = (self.upper(), context.peripheral(self.unit));
        let queue = serial::waiting_bytes(self.uart);
        let queue = queue.clamp(*QUEUE_BYTES.start(), *QUEUE_BYTES.end());
        let interrupt = context.interrupt(self.unit, "GLOBAL")?;
        section.bind(interrupt, format!("crate::{upper}Heard"));
        let registers = if hal.starts_with("LPUART") {
            format!("unsafe {{ rt::usart::low_power(hal::pac::{hal}.as_ptr()) }}")
        } else {
            format!("hal::pac::{hal}")
        };
        let mask = if self.uart.data_bits == 7 { "0x7F" } else { "0xFF" };
        let module = module(context.names.hal);
        section.begins.extend([
            format!("rt::{module}::listen({registers});"),
            "// Its handler is there.".to_owned(),
            format!("unsafe {{ interrupt::{interrupt}.enable() }};"),
        ]);
        section.items.push(Item::Line(format!(
            "static {upper}_HEARD: rt::serial::RxQueue<{queue}> = rt::serial::RxQueue::new();"
        )));
        section.items.push(Item::Handler(Handler {
            doc: format!("The bytes of {}", self.wire.place()),
            name: format!("{upper}Heard"),
            named_as: "the device",
            interrupt: interrupt.to_owned(),
            calls: vec![format!(
                "rt::{module}::on_interrupt(&{upper}_HEARD, {registers}, {mask});"
            )],
        }));
        Ok(())
    }

    /// What the task keeps of a device that says something.
    fn device(&self, context: &Context<'_>) -> Printed<Vec<String>> {
        let (upper, prefix) = (self.upper(), self.plan.prefix.to_uppercase());
        let own = self.plan.fields.iter().map(|one| context.item(&one.field));
        let own = own.collect::<Printed<Vec<_>>>()?;
        let gap_ms = serial::gap_ms(self.uart, self.plan);
        Ok(vec![
            format!(
                "let mut stream: sense_rt::MessageStream<[u8; tables::{prefix}_MESSAGE.stream_bytes(&SCHEMA)]> = \
                 sense_rt::MessageStream::new(&tables::{prefix}_MESSAGE, &SCHEMA);"
            ),
            format!(
                "let mut device = rt::serial::Device::new(&{upper}_HEARD, &mut stream, {gap_ms}, &{own:?});"
            ),
        ])
    }

    /// What the task does in a cycle. The first value of a cycle is reported, for that is when it is due; faults are
    /// all reported.
    fn cycle(&self, has_fields: bool, pass: &str) -> Vec<String> {
        let mut statements = Vec::new();
        if let (Some(said), false) = (&self.said, self.plan.init.is_empty()) {
            if has_fields {
                statements.push(format!(
                    "if device.is_forgotten({}) {{ start = sense_rt::MessageStart::NEW; }}",
                    self.wire.cycle.delay_ms
                ));
            }
            statements.push(format!(
                "rt::serial::set_up(&{said}, &mut start, tables::{}_INIT).await;",
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
