//! What a HAL says about the link to the host.

use sensedsl_job::{Pad, SerialLink};

use crate::context::Context;
use crate::section::{Constructor, Section};

/// The link to the host.
pub(crate) trait Link {
    /// The USB device, with its interrupt bound in the section; `None` if it cannot have its clock, or there is none.
    fn usb(&self, context: &Context<'_>, section: &mut Section) -> Option<UsbLink>;

    /// The serial port, whose queues are `tx` and `rx` of the wiring; `None` if the HAL has no driver for it.
    fn port(
        &self,
        context: &Context<'_>,
        port: &LinkPads<'_>,
        section: &mut Section,
    ) -> Option<PortLink>;
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

/// The link over a serial port.
pub(crate) struct PortLink {
    /// The handler of the port's interrupt.
    pub(crate) handler: String,
    /// The driver, which reads and writes through queues.
    pub(crate) made: Constructor,
}
