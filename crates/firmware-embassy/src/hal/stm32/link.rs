//! The link to the host: the USB device and the serial port.

use super::settings::Settings;
use crate::context::Context;
use crate::hal::contract::link::{Link, LinkPads, PortLink, UsbLink};
use crate::section::{Constructor, Section};

impl Link for Settings {
    fn usb(&self, context: &Context<'_>, section: &mut Section) -> Option<UsbLink> {
        let usb = context.profile.usb(None)?;
        // A USB device needs 48 MHz, which it only has if the firmware sets the clocks.
        let clock = self.line.clock.as_ref()?;
        let _ = clock.lines(&context.crystal(), true)?;
        let hal = context.peripheral(&usb.name);
        // The peripheral that can be a host as well has one interrupt; the plain device has one of low priority.
        let (interrupt, is_otg) = match context.names.interrupt(&usb.name, "GLOBAL") {
            Some(interrupt) => (interrupt, true),
            None => (context.names.interrupt(&usb.name, "LP")?, false),
        };
        section.bind(interrupt, format!("hal::usb::InterruptHandler<{hal}>"));
        let [dm, dp] = usb.pins.as_slice() else { return None };
        let vbus = usb.vbus.is_some() && context.job.board.link.vbus;
        if is_otg {
            section.features.insert("otg");
        }
        let make = if is_otg {
            format!(
                "hal::usb::Driver::new_fs(p.{hal}, Irqs, p.{dp}, p.{dm}, rx, crate::rt::usb::config({vbus}))"
            )
        } else {
            format!("hal::usb::Driver::new(p.{hal}, Irqs, p.{dp}, p.{dm})")
        };
        Some(UsbLink {
            comment: format!("the link at {dm} (D-) and {dp} (D+)"),
            made: Constructor { type_: format!("hal::usb::Driver<'static, {hal}>"), make },
            is_otg,
        })
    }

    fn port(
        &self,
        context: &Context<'_>,
        port: &LinkPads<'_>,
        section: &mut Section,
    ) -> Option<PortLink> {
        let LinkPads { link, tx, rx } = port;
        let hal = context.peripheral(link.unit);
        section.features.insert(self.port_feature());
        Some(PortLink {
            handler: format!("hal::usart::BufferedInterruptHandler<{hal}>"),
            made: Constructor {
                type_: "hal::usart::BufferedUart<'static>".to_owned(),
                make: format!(
                    "crate::rt::usart::port(hal::usart::BufferedUart::new{}(p.{hal}, p.{}, p.{}, tx, rx, Irqs, crate::rt::usart::link({})))",
                    self.generics(context, link.unit, &["_"]),
                    rx.pin.name,
                    tx.pin.name,
                    context.job.board.link.baud
                ),
            },
        })
    }
}
