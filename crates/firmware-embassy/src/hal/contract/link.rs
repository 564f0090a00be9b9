//! What a HAL says about the link to the host.

use sensedsl_job::{Pad, SerialLink};
use sensedsl_model::design::Transport;

use crate::context::Context;
use crate::section::{Constructor, Section};

/// The link to the host.
pub(crate) trait Link {
    /// The link as a port that carries bytes, whose task this driver has: its type has the method `run`. `None` if the
    /// link is one of the others.
    fn stream(
        &self,
        _context: &Context<'_>,
        _transport: Transport,
        _section: &mut Section,
    ) -> Option<StreamLink> {
        None
    }

    /// The USB device, with its interrupt bound in the section; `None` if it cannot have its clock, or there is none.
    /// Its data lines are not pins of the board table unless a HAL says so.
    fn usb(&self, context: &Context<'_>, section: &mut Section) -> Option<UsbLink> {
        let usb = context.profile.usb(None)?;
        let hal = context.peripheral(&usb.name);
        let interrupt = context.names.interrupt(&usb.name, "LP")?;
        section.bind(interrupt, format!("hal::usb::InterruptHandler<{hal}>"));
        Some(UsbLink {
            comment: "the link at the USB socket".to_owned(),
            made: Constructor {
                type_: format!("hal::usb::Driver<'static, {hal}>"),
                make: format!("hal::usb::Driver::new(p.{hal}, Irqs)"),
            },
            is_otg: false,
        })
    }

    /// The serial port, whose queues are `tx` and `rx` of the wiring; `None` if the HAL has no driver for it.
    fn port(
        &self,
        _context: &Context<'_>,
        _port: &LinkPads<'_>,
        _section: &mut Section,
    ) -> Option<PortLink> {
        None
    }
}

/// The serial port of the link with its pads.
pub(crate) struct LinkPads<'a> {
    pub(crate) link: &'a SerialLink<'a>,
    pub(crate) tx: &'a Pad<'a>,
    pub(crate) rx: &'a Pad<'a>,
}

/// The link over USB.
pub(crate) struct UsbLink {
    /// Where it is: `the link at the USB socket`.
    pub(crate) comment: String,
    /// The driver, which is an `embassy_usb` one.
    pub(crate) made: Constructor,
    /// Whether the peripheral can be a host as well: then it needs a buffer, `rx` of the wiring.
    pub(crate) is_otg: bool,
}

/// The link over a port that carries bytes.
pub(crate) struct StreamLink {
    /// Where it is: `the link at the USB socket`.
    pub(crate) comment: String,
    pub(crate) made: Constructor,
}

/// The link over a serial port.
pub(crate) struct PortLink {
    /// The handler of the port's interrupt.
    pub(crate) handler: String,
    /// The driver, which reads and writes through queues.
    pub(crate) made: Constructor,
}
