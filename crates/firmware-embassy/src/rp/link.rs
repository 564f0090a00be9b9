//! The link to the host: its USB device and its serial port.

use crate::context::Context;
use crate::link::{usb, usb_task};
use crate::section::{Field, Section};
use sensedsl_job::Pad;

/// The USB device, whose data lines are pins of their own.
pub(crate) fn over_usb(context: &Context<'_>, section: &mut Section) -> Option<()> {
    let usb = usb(context.job)?;
    let hal = context.peripheral(&usb.name);
    let type_ = format!("hal::usb::Driver<'static, {hal}>");
    let interrupt = context.names.interrupt(&usb.name, "LP")?;
    section.bind(interrupt, format!("hal::usb::InterruptHandler<{hal}>"));
    section.fields.push(Field {
        name: "link".to_owned(),
        comment: "the link at the USB socket".to_owned(),
        type_: type_.clone(),
        make: format!("hal::usb::Driver::new(p.{hal}, Irqs)"),
    });
    usb_task(context, &type_, section);
    Some(())
}

/// The handler of the link's port, its type, and what it is made of.
pub(crate) fn port(
    context: &Context<'_>,
    unit: &str,
    tx: &Pad<'_>,
    rx: &Pad<'_>,
    section: &mut Section,
) -> (String, String, String) {
    let hal = context.peripheral(unit);
    rest(context, rx, false, section);
    if let Some(interrupt) = context.names.interrupt(unit, "GLOBAL") {
        // The HAL waits for a level of the port's own queue, which few bytes do not reach.
        section.polls.push(vec![
            "// What waits behind the end of the queue goes on, however few bytes were before it."
                .to_owned(),
            format!("interrupt::{interrupt}.pend();"),
        ]);
    }
    (
        format!("hal::uart::BufferedInterruptHandler<{hal}>"),
        "hal::uart::BufferedUart".to_owned(),
        format!(
            "hal::uart::BufferedUart::new(p.{hal}, p.{}, p.{}, Irqs, tx, rx, \
             crate::rt::uart::config({}, 8, hal::uart::Parity::ParityNone, 1, false))",
            context.pin(&tx.pin.name),
            context.pin(&rx.pin.name),
            context.job.board.link.baud
        ),
    )
}

/// A wire that nothing drives rests: the HAL takes its resistors away.
pub(crate) fn rest(context: &Context<'_>, rx: &Pad<'_>, is_inverted: bool, section: &mut Section) {
    let pin = context.pin(&rx.pin.name);
    let number = pin.trim_start_matches("PIN_");
    let pull = if is_inverted { "pde" } else { "pue" };
    section
        .begins
        .push(format!("hal::pac::PADS_BANK0.gpio({number}).modify(|pad| pad.set_{pull}(true));"));
}
