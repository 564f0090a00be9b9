//! The link to the host: the USB device and the serial port.

use super::settings::Settings;
use crate::context::Context;
use crate::hal::contract::link::{Link, LinkPads, PortLink, UsbLink};
use crate::hal::contract::outputs::Pins as _;
use crate::section::{Constructor, Section};

impl Link for Settings {
    fn usb(&self, context: &Context<'_>, section: &mut Section) -> Option<UsbLink> {
        let usb = context.profile.usb(None)?;
        let hal = context.peripheral(&usb.name);
        let (interrupt, power) =
            (context.names.interrupt(&usb.name, "LP")?, context.names.interrupt(&usb.name, "HP")?);
        section.bind(interrupt, format!("hal::usb::InterruptHandler<{hal}>"));
        section.bind(power, "hal::usb::vbus_detect::InterruptHandler".to_owned());
        Some(UsbLink {
            comment: "the link at the USB socket".to_owned(),
            made: Constructor {
                type_: "hal::usb::Driver<'static, hal::usb::vbus_detect::HardwareVbusDetect>"
                    .to_owned(),
                make: format!(
                    "hal::usb::Driver::new(p.{hal}, Irqs, hal::usb::vbus_detect::HardwareVbusDetect::new(Irqs))"
                ),
            },
            is_otg: false,
        })
    }

    /// The HAL counts the bytes that come with a timer of its own, which no device can use.
    fn port(
        &self,
        context: &Context<'_>,
        port: &LinkPads<'_>,
        _section: &mut Section,
    ) -> Option<PortLink> {
        let LinkPads { link, tx, rx } = port;
        let hal = context.peripheral(link.unit);
        Some(PortLink {
            handler: format!("hal::buffered_uarte::InterruptHandler<{hal}>"),
            made: Constructor {
                type_: "hal::buffered_uarte::BufferedUarte<'static>".to_owned(),
                make: format!(
                    "hal::buffered_uarte::BufferedUarte::new(p.{hal}, p.TIMER0, p.PPI_CH0, p.PPI_CH5, p.PPI_GROUP0, \
                     p.{}, p.{}, Irqs, crate::rt::uart::link_config({}), rx, tx)",
                    self.pin(&rx.pin.name),
                    self.pin(&tx.pin.name),
                    context.job.board.link.baud
                ),
            },
        })
    }
}
