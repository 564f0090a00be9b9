//! Serial ports of devices.

use sensedsl_job::Pad;
use sensedsl_model::kind::uart::Uart;

use super::settings::Settings;
use crate::context::Context;
use crate::hal::contract::buses::{Half, Port, PortPins, Serial, parity};
use crate::hal::contract::outputs::Pins as _;
use crate::section::Section;

impl Serial for Settings {
    fn module(&self) -> &'static str {
        "uart"
    }

    fn half_type(&self, half: Half) -> String {
        format!("hal::uart::{}<'static, hal::uart::Blocking>", half.driver())
    }

    fn port(&self, context: &Context<'_>, port: &Port<'_>, section: &mut Section) -> String {
        let hal = context.peripheral(port.unit);
        if let Some(rx) = port.pins.rx() {
            section.begins.push(self.pull(rx, port.uart.is_inverted));
        }
        let pin = |pad: &Pad<'_>| format!("p.{}", self.pin(&pad.pin.name));
        let (half, pins) = match port.pins {
            PortPins::Both { rx, tx } => (Half::Both, format!("{}, {}", pin(tx), pin(rx))),
            PortPins::Rx(rx) => (Half::Rx, pin(rx)),
            PortPins::Tx(tx) => (Half::Tx, pin(tx)),
        };
        let config = config(port.uart);
        format!("hal::uart::{}::new_blocking(p.{hal}, {pins}, {config})", half.driver())
    }
}

impl Settings {
    /// Pulls a receiving pin to the level of a wire at rest, in case nothing drives it: the HAL has turned its
    /// resistors off.
    pub(super) fn pull(&self, rx: &Pad<'_>, is_inverted: bool) -> String {
        let pin = self.pin(&rx.pin.name);
        let number = pin.trim_start_matches("PIN_");
        let pull = if is_inverted { "pde" } else { "pue" };
        format!("hal::pac::PADS_BANK0.gpio({number}).modify(|pad| pad.set_{pull}(true));")
    }
}

/// The HAL's configuration.
fn config(uart: &Uart) -> String {
    let Uart { baud, data_bits, stop_bits, is_inverted, .. } = uart;
    let parity = parity(uart);
    format!(
        "crate::rt::uart::config({baud}, {data_bits}, hal::uart::Parity::{parity}, {stop_bits}, {is_inverted})"
    )
}
