//! Serial ports of devices.

use sensedsl_model::kind::uart::{Parity, Uart};

use super::settings::Settings;
use crate::context::Context;
use crate::hal::contract::buses::{Half, Hearing, Port, PortPins, Serial};
use crate::section::Section;

impl Serial for Settings {
    fn module(&self) -> &'static str {
        "uart"
    }

    fn hearing(&self) -> Hearing {
        Hearing::Task
    }

    fn can_invert(&self) -> bool {
        false
    }

    fn half_type(&self, half: Half) -> String {
        format!("crate::rt::uart::{}", half.driver())
    }

    fn port(&self, context: &Context<'_>, port: &Port<'_>, _section: &mut Section) -> String {
        let (unit, config) = (context.peripheral(port.unit), config(port.uart));
        let (half, pins) = match port.pins {
            PortPins::Both { rx, tx } => {
                (Half::Both, format!("p.{}, p.{}", rx.pin.name, tx.pin.name))
            }
            PortPins::Rx(pad) => (Half::Rx, format!("p.{}", pad.pin.name)),
            PortPins::Tx(pad) => (Half::Tx, format!("p.{}", pad.pin.name)),
        };
        format!("crate::rt::uart::{}::new(p.{unit}, {pins}, {config})", half.driver())
    }
}

/// The HAL's configuration.
fn config(uart: &Uart) -> String {
    let Uart { baud, data_bits, stop_bits, .. } = uart;
    let ones = match uart.parity {
        Parity::None => "Any",
        Parity::Even => "Even",
        Parity::Odd => "Odd",
    };
    format!(
        "crate::rt::uart::config({baud}, {data_bits}, crate::rt::uart::Ones::{ones}, {stop_bits})"
    )
}
