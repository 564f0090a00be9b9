//! The link to the host: a serial port, or the USB device beside the debugger. A task carries the bytes of both.

use sensedsl_model::design::Transport;
use sensedsl_model::kind::Role;

use super::settings::Settings;
use crate::context::Context;
use crate::hal::contract::link::{Link, StreamLink};
use crate::section::{Constructor, Section};

impl Link for Settings {
    fn stream(
        &self,
        context: &Context<'_>,
        transport: Transport,
        _section: &mut Section,
    ) -> Option<StreamLink> {
        match transport {
            Transport::Usb => {
                let hal = context.peripheral(&context.profile.usb(None)?.name);
                Some(StreamLink {
                    comment: "the link at the USB socket".to_owned(),
                    made: Constructor {
                        type_: "crate::rt::ports::Usb".to_owned(),
                        make: format!("crate::rt::ports::usb(p.{hal})"),
                    },
                })
            }
            Transport::Uart => {
                let link = context.job.link.as_ref()?;
                let pin = |role| Some(&link.pads.iter().find(|pad| pad.role == role)?.pin.name);
                let (tx, rx) = (pin(Role::Tx)?, pin(Role::Rx)?);
                let (hal, baud) = (context.peripheral(link.unit), context.job.board.link.baud);
                Some(StreamLink {
                    comment: format!("the link at {tx} (TX) and {rx} (RX)"),
                    made: Constructor {
                        type_: "crate::rt::ports::Port".to_owned(),
                        make: format!("crate::rt::ports::port(p.{hal}, p.{rx}, p.{tx}, {baud})"),
                    },
                })
            }
            Transport::None => None,
        }
    }
}
