//! Serial ports of devices.

use sensedsl_job::Pad;
use sensedsl_model::kind::uart::{Parity, Uart};

use super::settings::Settings;
use crate::context::Context;
use crate::hal::contract::buses::{Half, Port, PortPins, Serial};
use crate::hal::contract::outputs::Pins as _;
use crate::section::Section;

impl Serial for Settings {
    fn module(&self) -> &'static str {
        "uart"
    }

    fn can_invert(&self) -> bool {
        false
    }

    /// The runtime has drivers of its own: those of the HAL wait for a number of bytes.
    fn half_type(&self, half: Half) -> String {
        format!("crate::rt::uart::{}", half.driver())
    }

    fn port(&self, context: &Context<'_>, port: &Port<'_>, _section: &mut Section) -> String {
        let (unit, config) = (context.peripheral(port.unit), config(port.uart));
        let pin = |pad: &Pad<'_>| format!("p.{}.into()", self.pin(&pad.pin.name));
        let (half, pins) = match port.pins {
            PortPins::Both { rx, tx } => {
                (Half::Both, format!("Some({}), Some({})", pin(rx), pin(tx)))
            }
            PortPins::Rx(rx) => (Half::Rx, pin(rx)),
            PortPins::Tx(tx) => (Half::Tx, pin(tx)),
        };
        format!(
            "crate::rt::uart::{}::new(p.{unit}, hal::pac::{unit}, {pins}, &{config})",
            half.driver()
        )
    }
}

/// The runtime's configuration.
fn config(uart: &Uart) -> String {
    let Uart { baud, stop_bits, .. } = uart;
    let has_parity = uart.parity != Parity::None;
    format!(
        "crate::rt::uart::Config {{ baud: {baud}, has_parity: {has_parity}, stop_bits: {stop_bits} }}"
    )
}
