//! The link to the host: the USB device and the serial port.

use super::settings::Settings;
use crate::context::Context;
use crate::hal::contract::link::{Link, LinkPads, PortLink};
use crate::hal::contract::outputs::Pins as _;
use crate::section::{Constructor, Section};

impl Link for Settings {
    fn port(
        &self,
        context: &Context<'_>,
        port: &LinkPads<'_>,
        section: &mut Section,
    ) -> Option<PortLink> {
        let LinkPads { link, tx, rx } = port;
        let hal = context.peripheral(link.unit);
        section.begins.push(self.pull(rx, false));
        if let Some(interrupt) = context.names.interrupt(link.unit, "GLOBAL") {
            // The HAL waits until the port's own queue is full to a level, which few bytes do not reach.
            section.polls.push(vec![
                "// What waits behind the end of the queue goes on, however few bytes were before it."
                    .to_owned(),
                format!("interrupt::{interrupt}.pend();"),
            ]);
        }
        Some(PortLink {
            handler: format!("hal::uart::BufferedInterruptHandler<{hal}>"),
            made: Constructor {
                type_: "hal::uart::BufferedUart".to_owned(),
                make: format!(
                    "hal::uart::BufferedUart::new(p.{hal}, p.{}, p.{}, Irqs, tx, rx, \
                     crate::rt::uart::config({}, 8, hal::uart::Parity::ParityNone, 1, false))",
                    self.pin(&tx.pin.name),
                    self.pin(&rx.pin.name),
                    context.job.board.link.baud
                ),
            },
        })
    }
}
