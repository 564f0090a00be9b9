//! Serial ports of devices.

use sensedsl_model::kind::uart::{Duplex, Uart};

use super::settings::Settings;
use crate::context::Context;
use crate::hal::contract::buses::{Half, Port, PortPins, Serial, parity};
use crate::section::Section;

impl Serial for Settings {
    fn module(&self) -> &'static str {
        "usart"
    }

    fn can_invert(&self) -> bool {
        !self.has_old_ports()
    }

    fn has_one_wire(&self) -> bool {
        true
    }

    fn half_type(&self, half: Half) -> String {
        format!("hal::usart::{}<'static, hal::mode::Blocking>", half.driver())
    }

    /// The HAL refuses rates that a unit cannot make, which is a fault of the runtime.
    fn port(&self, context: &Context<'_>, port: &Port<'_>, section: &mut Section) -> String {
        section.features.insert(self.port_feature());
        let hal = context.peripheral(port.unit);
        if let (PortPins::Tx(tx), Duplex::Half) = (port.pins, port.uart.exchange.duplex) {
            return format!(
                "crate::rt::usart::port(hal::usart::Uart::new_blocking_half_duplex{}(p.{hal}, p.{}, \
                 crate::rt::usart::one_wire({}), hal::usart::HalfDuplexReadback::Readback))",
                self.generics(context, port.unit, &["_"]),
                tx.pin.name,
                config(port.uart)
            );
        }
        let (half, pins) = match port.pins {
            PortPins::Both { rx, tx } => {
                (Half::Both, format!("p.{}, p.{}", rx.pin.name, tx.pin.name))
            }
            PortPins::Rx(rx) => (Half::Rx, format!("p.{}", rx.pin.name)),
            PortPins::Tx(tx) => (Half::Tx, format!("p.{}", tx.pin.name)),
        };
        format!(
            "crate::rt::usart::port(hal::usart::{}::new_blocking{}(p.{hal}, {pins}, {}))",
            half.driver(),
            self.generics(context, port.unit, &["_"]),
            config(port.uart)
        )
    }

    /// Low-power ports have registers of another type.
    fn registers(&self, unit: &str) -> String {
        if unit.starts_with("LPUART") {
            format!("unsafe {{ rt::usart::low_power(hal::pac::{unit}.as_ptr()) }}")
        } else {
            format!("hal::pac::{unit}")
        }
    }
}

/// The HAL's configuration.
fn config(uart: &Uart) -> String {
    let Uart { baud, data_bits, stop_bits, is_inverted, .. } = uart;
    let parity = parity(uart);
    let config = format!(
        "crate::rt::usart::config({baud}, {data_bits}, hal::usart::Parity::{parity}, {stop_bits})"
    );
    if *is_inverted { format!("crate::rt::usart::inverted({config})") } else { config }
}
