//! The link to the host: over USB with a task of its own, or over a serial port that the reporter has.

use sensedsl_diagnostics::Diagnostic;
use sensedsl_diagnostics::codes::e0504_no_firmware_target;
use sensedsl_model::design::Transport;
use sensedsl_model::kind::Role;

use super::context::Context;
use super::hal::contract::Drivers;
use super::hal::contract::link::{Link, LinkPads, StreamLink, UsbLink};
use super::item::{Item, Task};
use super::section::{Constructor, Field, Keep, LinkPlan, Section, Start};

pub(super) fn plan(
    context: &Context<'_>,
    drivers: &dyn Drivers,
    diagnostics: &mut Vec<Diagnostic>,
) -> Section {
    let mut section = Section::default();
    let transport = context.job.board.link.transport;
    if let Some(stream) = drivers.link().stream(context, transport, &mut section) {
        over_stream(stream, &mut section);
        return section;
    }
    let made = match transport {
        Transport::Usb => over_usb(context, drivers.link(), &mut section),
        Transport::Uart => over_uart(context, drivers.link(), &mut section),
        Transport::None => None,
    };
    if made.is_none() {
        let name = &context.job.board.name;
        let why = match transport {
            Transport::None => "it has no link to send reports over (`transport = none`)",
            Transport::Usb => {
                "USB needs a clock of 48 MHz, which its firmware cannot make without a crystal, or not on this MCU yet; \
                 take `link { transport = uart; }`"
            }
            Transport::Uart => "its target has no driver for the link",
        };
        diagnostics.push(e0504_no_firmware_target::no_firmware_target(name.span, &name.value, why));
    }
    section
}

fn over_uart(context: &Context<'_>, driver: &dyn Link, section: &mut Section) -> Option<()> {
    let link = context.job.link.as_ref()?;
    let pad = |role| link.pads.iter().find(|pad| pad.role == role);
    let (tx, rx) = (pad(Role::Tx)?, pad(Role::Rx)?);
    let interrupt = context.names.interrupt(link.unit, "GLOBAL")?;
    let port = driver.port(context, &LinkPads { link, tx, rx }, section)?;
    section.bind(interrupt, port.handler);
    let Constructor { type_, make } = port.made;
    let type_ = format!("rt::link_uart::Port<{type_}>");
    section.fields.push(Field {
        name: "link".to_owned(),
        comment: format!("the link at {} (TX) and {} (RX)", tx.pin.name, rx.pin.name),
        type_: format!("crate::{type_}"),
        make: format!("crate::rt::link_uart::Port::new({make}, crate::TX_BYTES)"),
    });
    section.link = LinkPlan::Uart;
    section.keeps.push(Keep { name: "mut link".to_owned(), type_, from: "wiring.link".to_owned() });
    Some(())
}

fn over_stream(stream: StreamLink, section: &mut Section) {
    let StreamLink { comment, made } = stream;
    task(&made, "device.run(&LINK).await;".to_owned(), section);
    section.fields.push(Field::of("link".to_owned(), comment, made));
    section.link = LinkPlan::Stream;
}

fn over_usb(context: &Context<'_>, link: &dyn Link, section: &mut Section) -> Option<()> {
    let UsbLink { comment, made, is_otg } = link.usb(context, section)?;
    let product = &context.job.board.name.value;
    task(&made, format!("rt::link_usb::run(device, {product:?}, &LINK).await;"), section);
    section.fields.push(Field::of("link".to_owned(), comment, made));
    section.link = if is_otg { LinkPlan::Otg } else { LinkPlan::Usb };
    Some(())
}

/// The task of the link's driver. `runs` is its only statement.
fn task(made: &Constructor, runs: String, section: &mut Section) {
    let mut task = Task::new("The link's device".to_owned(), "link".to_owned());
    task.parameters.push(format!("device: {}", made.type_));
    task.before.push(runs);
    section.items.push(Item::Task(task));
    section.starts.push(Start::Task(0, "link(wiring.link)".to_owned()));
}

/// The size of a port's queue for what the host sends: twice what comes from one cycle of the reporter to the next.
pub(super) fn received_bytes(baud: u32, report_ms: u32) -> u32 {
    const BITS_OF_BYTE: u32 = 10;
    let bytes_each_ms = baud.div_ceil(BITS_OF_BYTE * 1_000);
    bytes_each_ms.saturating_mul(2 * report_ms).clamp(64, 1_024).next_power_of_two()
}
