//! H0806: the source leaves something open.

use crate::codes::{Code, CodeInfo};
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;

/// The registry entry.
pub const INFO: CodeInfo = CodeInfo {
    code: "H0806",
    severity: Severity::Hint,
    title: "the source leaves something open",
    explanation: r#"A project for an MCU says which pins are a bus, but not what hangs on it: the address of an I2C device,
the bytes of an SPI transfer or the frame of a CAN message are in its program text. The device stands in
the result as a comment, with its pins.

Way out: fill in what is missing and take the comment signs away.
"#,
};

/// The code.
pub const CODE: Code = Code(&INFO);

/// `what` is what is left open.
#[must_use]
pub fn import_open(span: Span, what: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, what).help("fill it in and take the comment signs away")
}
