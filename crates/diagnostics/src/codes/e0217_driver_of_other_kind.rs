//! E0217: the driver is for another kind.

use crate::codes::{Code, CodeInfo};
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;

/// The registry entry.
pub const INFO: CodeInfo = CodeInfo {
    code: "E0217",
    severity: Severity::Error,
    title: "the driver is for another kind",
    explanation: r#"A driver is written for one kind of connection; an i2c protocol cannot drive a uart.

Way out: change the device's `type`, or take another driver.
"#,
};

/// The code.
pub const CODE: Code = Code(&INFO);

/// `its` is the kind of the driver, `kind` that of the device.
#[must_use]
pub fn driver_of_other_kind(span: Span, driver: &str, its: &str, kind: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{driver}` is {its}, and the device is {kind}"))
        .help(format!("leave `type` out, which the driver says, or take a driver for {kind}"))
}
