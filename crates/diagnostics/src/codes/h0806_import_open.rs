//! H0806: the source leaves something open.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "H0806",
    title: "the source leaves something open",
    explanation: r#"A project for an MCU says which pins are a bus, but not what hangs on it: the address of an I2C device,
the bytes of an SPI transfer or the frame of a CAN message are in its program text. The device stands in
the result as a comment, with its pins.

Way out: fill in what is missing and take the comment signs away."#,
});

/// `what` is what is left open.
pub fn import_open(span: Span, what: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, what).help("fill it in and take the comment signs away")
}
