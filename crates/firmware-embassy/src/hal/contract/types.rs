//! What a HAL says about types: wires that only compile if the HAL knows them.

use sensedsl_board::signal::Function;
use sensedsl_model::kind::KindName;

use crate::context::Context;

/// The wiring in types. Each line calls a function of the crate that is printed; `unit` and `pin` are always among
/// them.
pub(crate) trait Types {
    /// The features of the HAL for a check, the chip's among them.
    fn features(&self, context: &Context<'_>) -> Vec<String>;

    /// Conditions of `templates/packages.txt` that hold for the check, beside the name of the HAL.
    fn lock_tags(&self, _context: &Context<'_>) -> Vec<&'static str> {
        Vec::new()
    }

    /// `.cargo/config.toml` of the check; `None` if it needs none.
    fn cargo_config(&self, _context: &Context<'_>) -> Option<&'static str> {
        None
    }

    /// The functions that lines may call: the name, and the signature from the type parameters on.
    fn calls(&self) -> Vec<(&'static str, String)>;

    /// The crate. The lines are its last ones, but for a brace.
    fn print(&self, calls: &[(&'static str, String)], lines: &[String]) -> String;

    /// The line of a wire with a signal; `None` if the HAL has no types for it. `unit` is the profile's name of the
    /// unit, `pin` the HAL's of the pin.
    fn wire(
        &self,
        context: &Context<'_>,
        unit: &str,
        function: &Function,
        pin: &str,
    ) -> Option<String>;

    /// The line of an input whose edges interrupt. `line` is its interrupt line.
    fn edge(&self, pin: &str, _line: u8) -> String {
        format!("pin(p.{pin});")
    }

    /// The line of a DMA channel that serves a request; `None` if the HAL's driver takes none.
    fn channel(&self, request: &Request<'_>, channel: &str) -> Option<String>;

    /// The line of a data line of the USB device; `None` if it has no types for its pins. `unit` is the HAL's name.
    fn usb(&self, _unit: &str, _wire: UsbWire, _pin: &str) -> Option<String> {
        None
    }
}

/// A request for a DMA channel.
pub(crate) struct Request<'a> {
    /// The HAL's name of the unit.
    pub(crate) unit: &'a str,
    /// The kind that the unit serves.
    pub(crate) kind: KindName,
    /// The signal: `TX`.
    pub(crate) signal: Option<&'a str>,
}

/// A data line of a USB device.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum UsbWire {
    Minus,
    Plus,
}
