//! A port with its device: its settings, what is sent and what is received.

use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::kind::uart::{Parity, Uart};
use sensedsl_model::kind::{KindName, Role};

use super::line;
use crate::context::{Context, Drive};
use crate::names::Setting;
use crate::section::{Apply, Section, Size, Work};
use crate::stacks::Depth;
use sensedsl_board::signal::UnitName;
use sensedsl_files::{block, templates};
use sensedsl_job::kinds::serial::{self, QUEUE_BYTES};
use sensedsl_job::part::MessagePlan;
use sensedsl_job::{Cycle, JobConnection};

/// The stack depth of its thread.
const DEPTH: Depth = Depth { plain: [560, 488], filtered: [656, 500] };

templates! {
    s: Ports;
    Tables = "uart/v1.c.txt";
}

struct Ports {
    ports: Vec<Port>,
}

/// A port with a device.
struct Port {
    ident: String,
    /// The device and its pins, for people.
    place: String,
    unit: String,
    driver: String,
    baud: u32,
    /// The frame format for people: `8E2, inverted`.
    frame: String,
    /// Register values besides the driver's own; empty for none.
    cr1: String,
    cr2: String,
    prefix: String,
    init: usize,
    fields: usize,
    gap_ms: u32,
    cycle: Cycle,
    id: u8,
}

/// The version whose ports cannot invert.
const WITHOUT_INVERSION: &str = "USARTv1";

pub(super) fn plan(context: &Context<'_>, diagnostics: &mut Vec<Diagnostic>) -> Section {
    let mut section = Section::default();
    let (mut ports, mut queue_bytes, mut send_bytes) = (Vec::new(), 0, 1);
    let lines = line::add(context, &mut section, diagnostics);
    for wired in context.connections(KindName::Uart) {
        if serial::is_dialogue(context.job, wired) {
            continue;
        }
        let Some(uart) = uart(context, wired) else { continue };
        let Some(message) = context.job.tables_of(wired).and_then(|plan| plan.message.as_ref())
        else {
            continue;
        };
        let Some(port) = Port::new(context, wired, uart, message) else { continue };
        diagnostics.extend(not_inverted(context, wired, uart));
        for pad in &wired.pads {
            let drive =
                if pad.role == Role::Rx { Drive::Resting(!uart.is_inverted) } else { Drive::Plain };
            section.pads.extend(context.alternate_pad(pad, drive, diagnostics));
        }
        let sent = message.commands.iter().map(|one| u32::from(one.bytes)).max().unwrap_or(0);
        let reported = message.init.iter().map(|one| one.bytes.len()).max().unwrap_or(0);
        send_bytes = send_bytes.max(sent);
        let needed = serial::waiting_bytes(uart);
        let needed = needed.max(2 * sent).max(u32::try_from(reported).unwrap_or(0));
        queue_bytes = queue_bytes.max(needed.clamp(*QUEUE_BYTES.start(), *QUEUE_BYTES.end()));
        section.units.insert(UnitName::new(&port.unit));
        section.clocks.extend(context.profile.unit(&port.unit).and_then(|unit| unit.clock.clone()));
        section.starts.push(format!("up_uart_start(&{});", port.table()));
        section.applies.extend(message.commands.iter().map(|one| Apply {
            field: one.field.clone(),
            line: format!("up_uart_send(&{}, &compose_{}, field, value);", port.table(), one.field),
        }));
        section.work.extend(port.work());
        ports.push(port);
    }
    let queue_bytes = queue_bytes.max(lines.queue_bytes);
    if queue_bytes > 0 {
        section.switch = Some(Setting::new("HAL_USE_SERIAL", "TRUE"));
        section.hal =
            vec![Setting::new("SERIAL_BUFFERS_SIZE", &queue_bytes.next_power_of_two().to_string())];
    }
    if !ports.is_empty() {
        section.tables = block(&Tables { s: &Ports { ports } });
    }
    let size = |comment, name, bytes: u32| Size {
        comment,
        setting: Setting::new(name, &format!("{bytes}U")),
    };
    section.tables.push_str(&lines.tables);
    section.sizes = vec![
        size(
            "The longest message that a serial device is sent.",
            "UP_UART_SEND_BYTES_MAX",
            send_bytes,
        ),
        size("The longest one on a line with answers.", "UP_LINE_SEND_BYTES_MAX", lines.send_bytes),
    ];
    section
}

/// A port that cannot invert its wires, and a device that wants that.
pub(super) fn not_inverted(
    context: &Context<'_>,
    wired: &JobConnection<'_>,
    uart: &Uart,
) -> Option<Diagnostic> {
    let is_wrong = uart.is_inverted && context.names.drivers.serial == WITHOUT_INVERSION;
    is_wrong.then(|| serial::not_inverted(wired.part, context.profile))
}

/// The settings of a connection's port.
fn uart<'a>(context: &Context<'a>, wired: &JobConnection<'a>) -> Option<&'a Uart> {
    let own = wired.connection.kind.uart();
    own.or_else(|| context.device_of(wired)?.device.kind.uart())
}

impl Port {
    fn new(
        context: &Context<'_>,
        wired: &JobConnection<'_>,
        uart: &Uart,
        message: &MessagePlan,
    ) -> Option<Self> {
        let unit = wired.unit?;
        Some(Self {
            ident: wired.ident.clone(),
            place: wired.place(),
            unit: unit.to_owned(),
            driver: context.names.driver(unit)?,
            baud: uart.baud,
            frame: frame(uart),
            cr1: cr1(uart),
            cr2: cr2(uart),
            prefix: message.prefix.clone(),
            init: message.init.len(),
            fields: message.fields.len(),
            gap_ms: serial::gap_ms(uart, message),
            cycle: wired.cycle,
            id: context.id_of(wired),
        })
    }

    fn table(&self) -> String {
        format!("{}_port", self.ident)
    }

    /// The work of its thread, if it receives something or the device must be started.
    fn work(&self) -> Option<Work> {
        (self.fields > 0 || self.init > 0).then(|| Work {
            unit: self.unit.clone(),
            cycle: self.cycle,
            function: "up_uart_cycle",
            table: self.table(),
            device: self.id,
            depth: DEPTH,
        })
    }
}

/// The frame format for people.
pub(super) fn frame(uart: &Uart) -> String {
    let parity = match uart.parity {
        Parity::None => 'N',
        Parity::Even => 'E',
        Parity::Odd => 'O',
    };
    let inverted = if uart.is_inverted { ", inverted" } else { "" };
    format!("{}{parity}{}{inverted}", uart.data_bits, uart.stop_bits)
}

/// Parity, and whether it follows eight data bits.
pub(super) fn cr1(uart: &Uart) -> String {
    let nine = if uart.data_bits == 8 { "UP_UART_NINE_BITS | " } else { "" };
    match uart.parity {
        Parity::None => String::new(),
        Parity::Even => format!("{nine}USART_CR1_PCE"),
        Parity::Odd => format!("{nine}USART_CR1_PCE | USART_CR1_PS"),
    }
}

/// Stop bits and inversion.
pub(super) fn cr2(uart: &Uart) -> String {
    let stop = (uart.stop_bits == 2).then_some("USART_CR2_STOP_1");
    let invert = uart.is_inverted.then_some("USART_CR2_RXINV | USART_CR2_TXINV");
    let all: Vec<&str> = stop.into_iter().chain(invert).collect();
    all.join(" | ")
}
