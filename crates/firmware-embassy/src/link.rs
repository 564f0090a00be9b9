//! The link to the host.

use sensedsl_board::profile::Usb;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_diagnostics::codes::e0504_no_firmware_target;
use sensedsl_model::design::Transport;
use sensedsl_model::kind::Role;

use super::context::Context;
use super::hal::Hal;
use super::item::{Item, Task};
use super::rp;
use super::section::{Field, Keep, LinkPlan, Section, Start};
use sensedsl_job::{BoardJob, Pad};

/// The USB device of a board, whatever its system.
pub(super) fn usb(job: &BoardJob<'_>) -> Option<Usb> {
    job.profile?.usb(None).cloned()
}

pub(super) fn plan(context: &Context<'_>, diagnostics: &mut Vec<Diagnostic>) -> Section {
    let mut section = Section::default();
    let made = match context.job.board.link.transport {
        Transport::Usb => match context.names.hal {
            Hal::Stm32 => over_usb(context, &mut section),
            Hal::Rp => rp::link::over_usb(context, &mut section),
        },
        Transport::Uart => over_uart(context, &mut section),
        Transport::None => None,
    };
    if made.is_none() {
        let name = &context.job.board.name;
        let why = match context.job.board.link.transport {
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

fn over_uart(context: &Context<'_>, section: &mut Section) -> Option<()> {
    let link = context.job.link.as_ref()?;
    let pad = |role| link.pads.iter().find(|pad| pad.role == role);
    let (tx, rx) = (pad(Role::Tx)?, pad(Role::Rx)?);
    let interrupt = context.names.interrupt(link.unit, "GLOBAL")?;
    let (handler, type_, make) = match context.names.hal {
        Hal::Stm32 => port(context, link.unit, tx, rx, section),
        Hal::Rp => rp::link::port(context, link.unit, tx, rx, section),
    };
    section.bind(interrupt, handler);
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

/// The handler of the link's port, its type, and what it is made of.
fn port(
    context: &Context<'_>,
    unit: &str,
    tx: &Pad<'_>,
    rx: &Pad<'_>,
    section: &mut Section,
) -> (String, String, String) {
    let hal = context.peripheral(unit);
    section.features.extend(context.names.port_feature());
    (
        format!("hal::usart::BufferedInterruptHandler<{hal}>"),
        "hal::usart::BufferedUart<'static>".to_owned(),
        format!(
            "crate::rt::usart::port(hal::usart::BufferedUart::new{}(p.{hal}, p.{}, p.{}, tx, rx, Irqs, crate::rt::usart::link({})))",
            context.generics(unit, &["_"]),
            rx.pin.name,
            tx.pin.name,
            context.job.board.link.baud
        ),
    )
}

fn over_usb(context: &Context<'_>, section: &mut Section) -> Option<()> {
    let usb = usb(context.job)?;
    // A USB device needs 48 MHz, which only clocks of our own making have.
    let clock = context.names.line.clock.as_ref()?;
    let _ = clock.lines(&context.crystal(), true)?;
    let hal = context.peripheral(&usb.name);
    // The peripheral that can be a host as well has one interrupt, the plain device one of low priority.
    let (signal, is_otg) = match context.names.interrupt(&usb.name, "GLOBAL") {
        Some(interrupt) => (interrupt, true),
        None => (context.names.interrupt(&usb.name, "LP")?, false),
    };
    section.bind(signal, format!("hal::usb::InterruptHandler<{hal}>"));
    let [dm, dp] = usb.pins.as_slice() else { return None };
    let vbus = usb.vbus.is_some() && context.job.board.link.vbus;
    section.fields.push(Field {
        name: "link".to_owned(),
        comment: format!("the link at {dm} (D-) and {dp} (D+)"),
        type_: format!("hal::usb::Driver<'static, {hal}>"),
        make: if is_otg {
            format!("hal::usb::Driver::new_fs(p.{hal}, Irqs, p.{dp}, p.{dm}, rx, crate::rt::usb::config({vbus}))")
        } else {
            format!("hal::usb::Driver::new(p.{hal}, Irqs, p.{dp}, p.{dm})")
        },
    });
    usb_task(context, &format!("hal::usb::Driver<'static, {hal}>"), section);
    if is_otg {
        section.features.insert("otg");
        section.link = LinkPlan::Otg;
    }
    Some(())
}

/// The task of the USB device, whose driver is of that type.
pub(super) fn usb_task(context: &Context<'_>, driver: &str, section: &mut Section) {
    let product = &context.job.board.name.value;
    let mut task = Task::new("The link's device".to_owned(), "link".to_owned());
    task.parameters.push(format!("device: {driver}"));
    task.before.push(format!("rt::link_usb::run(device, {product:?}, &LINK).await;"));
    section.items.push(Item::Task(task));
    section.link = LinkPlan::Usb;
    section.starts.push(Start::Task(0, "link(wiring.link)".to_owned()));
}

/// What a port must hold of what the host sends: twice what comes between two looks of the reporter.
pub(super) fn heard_bytes(baud: u32, report_ms: u32) -> u32 {
    const BITS_OF_BYTE: u32 = 10;
    let bytes_each_ms = baud.div_ceil(BITS_OF_BYTE * 1_000);
    bytes_each_ms.saturating_mul(2 * report_ms).clamp(64, 1_024).next_power_of_two()
}
