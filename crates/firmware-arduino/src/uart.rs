//! Devices on serial ports that speak by themselves, or are told something.

use sensedsl_diagnostics::Diagnostic;
use sensedsl_files::{block, templates};
use sensedsl_job::kinds::serial;
use sensedsl_job::part::MessagePlan;
use sensedsl_job::{BoardJob, JobConnection};
use sensedsl_model::kind::uart::{Parity, Uart};
use sensedsl_model::kind::{KindName, Role};

use crate::context::Context;
use crate::section::{Apply, Cost, PortPlan, Section, Work};

/// An object of the framework with its buffers' pointers, an `up_uart_state_t` and an `up_message_state_t`.
const PORT_BYTES: u32 = 29 + 11 + 27;

/// The core's code for messages that come, and for those that are sent.
const RECEIVE_FLASH_BYTES: u32 = 5_900;
const SEND_FLASH_BYTES: u32 = 1_200;

templates! {
    s: Ports;
    Tables = "uart.c.txt";
}

struct Ports {
    ports: Vec<Port>,
}

struct Port {
    ident: String,
    place: String,
    baud: u32,
    prefix: String,
    number: usize,
    init: usize,
    fields: usize,
    gap_ms: u32,
    cycle_ms: u32,
}

pub(crate) fn lacks(job: &BoardJob<'_>, connection: &JobConnection<'_>) -> Option<&'static str> {
    if serial::is_dialogue(job, connection) {
        return Some("lines on which parts are asked");
    }
    let uart = serial::uart_of(job, connection)?;
    uart.is_inverted.then_some("the inverted wires that ports of an AVR lack")
}

pub(crate) fn plan(context: &Context<'_>, _: &mut Vec<Diagnostic>) -> Section {
    let mut section = Section::default();
    let (mut ports, mut send_bytes) = (Vec::new(), 1);
    for wire in context.job.connections(KindName::Uart) {
        let Some(uart) = serial::uart_of(context.job, wire) else { continue };
        let plan = context.job.tables_of(wire).and_then(|plan| plan.message.as_ref());
        let object = wire.unit.and_then(|unit| context.names.object(unit));
        let (Some(message), Some(object)) = (plan, object) else { continue };
        let port = Port::new(wire, uart, message, ports.len());
        let table = format!("{}_port", port.ident);
        // A wire to a part that is not there must not look like data.
        let rx = context.number(wire, Role::Rx);
        section.pads.extend(rx.map(|number| format!("pinMode({number}, INPUT_PULLUP);")));
        section.ports.push(PortPlan {
            object: object.to_owned(),
            baud: uart.baud,
            frame: frame(uart),
        });
        section.applies.extend(message.commands.iter().map(|one| Apply {
            field: one.field.clone(),
            line: format!("up_uart_send(&{table}, &compose_{}, field, value);", one.field),
        }));
        let sent = message.commands.iter().map(|one| u32::from(one.bytes)).max().unwrap_or(0);
        send_bytes = send_bytes.max(sent);
        section.work.extend(port.work(context, wire));
        if port.fields > 0 {
            section.drains.push(format!("up_uart_drain(&{table});"));
        }
        let buffers = context.names.uart_buffers_bytes + u32::from(message.bytes_max);
        let name = format!("the port {object} of {}", wire.title);
        section.costs.push(Cost::new(name, PORT_BYTES + buffers, 600));
        ports.push(port);
    }
    section.sizes.push(("UP_UART_SEND_BYTES_MAX", send_bytes));
    if !ports.is_empty() {
        section.headers.push("up_uart.h");
        let receives = ports.iter().any(|port| port.fields > 0);
        section
            .costs
            .extend(receives.then(|| Cost::new("messages of devices", 0, RECEIVE_FLASH_BYTES)));
        let sends = !section.applies.is_empty();
        section.costs.extend(sends.then(|| Cost::new("messages to devices", 0, SEND_FLASH_BYTES)));
        section.tables = block(&Tables { s: &Ports { ports } });
    }
    section
}

/// The framework's word for a frame: `SERIAL_8N1`.
fn frame(uart: &Uart) -> String {
    let parity = match uart.parity {
        Parity::None => 'N',
        Parity::Even => 'E',
        Parity::Odd => 'O',
    };
    format!("SERIAL_{}{parity}{}", uart.data_bits, uart.stop_bits)
}

impl Port {
    fn new(wire: &JobConnection<'_>, uart: &Uart, message: &MessagePlan, number: usize) -> Self {
        Self {
            ident: wire.ident.clone(),
            place: wire.place(),
            baud: uart.baud,
            prefix: message.prefix.clone(),
            number,
            init: message.init.len(),
            fields: message.fields.len(),
            gap_ms: serial::gap_ms(uart, message),
            cycle_ms: wire.cycle.delay_ms,
        }
    }

    /// The work of its cycle, if something is received or the device must be started.
    fn work(&self, context: &Context<'_>, wire: &JobConnection<'_>) -> Option<Work> {
        let device = wire.devices.first().and_then(|index| context.job.devices.get(*index))?;
        (self.fields > 0 || self.init > 0).then(|| Work {
            title: wire.cycle.title(wire.unit.unwrap_or_default()),
            function: "up_uart_cycle",
            table: format!("{}_port", self.ident),
            cycle: wire.cycle,
            field: device.name().to_owned(),
        })
    }
}
