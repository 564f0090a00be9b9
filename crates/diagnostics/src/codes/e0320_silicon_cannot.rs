//! E0320: the MCU's silicon cannot do what the device needs.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0320",
    title: "the MCU cannot do that",
    explanation: r#"The board has the pins, but its MCU's peripherals lack what the device needs: the PWM slices of an RP2040
cannot decode quadrature, for example, and capture on channel B only. The message says what is missing.

Way out: take another pin where the message lists some, another kind of connection, or another board; `sensedsl parts FILE`
lists the parts and boards that can carry the devices."#,
});

/// A kind that the MCU cannot serve on any pin, and why.
pub fn silicon_cannot(span: Span, device: &str, kind: &str, mcu: &str, because: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{device}` cannot be {kind} on {mcu}: {because}"))
        .help("connect the device in another way, or take another board: `sensedsl parts FILE` lists those that can carry it")
}

/// A fixed unit that cannot serve, why, and which units can.
pub fn unit_cannot(span: Span, unit: &str, kind: &str, because: &str, units: &str) -> Diagnostic {
    let message = format!("{unit} cannot serve {kind}: {because}");
    let diagnostic = Diagnostic::new(CODE, span, message).here("fixed here");
    if units.is_empty() {
        diagnostic.help(format!("no unit of the board can serve {kind}"))
    } else {
        diagnostic.help(format!("take one of {units}, or remove the line and let the tool choose"))
    }
}

/// A fixed pin on a channel that cannot serve, why, and which pins can.
pub fn channel_cannot(span: Span, pin: &str, needs: &str, because: &str, pins: &str) -> Diagnostic {
    let diagnostic =
        Diagnostic::new(CODE, span, format!("{pin} cannot be {needs}: {because}")).here("fixed here");
    if pins.is_empty() {
        diagnostic.help(format!("no pin of the board can be {needs}"))
    } else {
        diagnostic.help(format!("take one of {pins}, or remove the line and let the tool choose"))
    }
}
