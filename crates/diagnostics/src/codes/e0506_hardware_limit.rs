//! E0506: the driver cannot do this.

use crate::codes::{Code, CodeInfo};
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;

/// The registry entry.
pub const INFO: CodeInfo = CodeInfo {
    code: "E0506",
    severity: Severity::Error,
    title: "the driver cannot do this",
    explanation: r#"The wiring exists, but the operating system's driver or the peripheral has a limit that the request
exceeds: too many channels in a conversion group, a clock that does not divide, a frequency out of
reach.

Way out: change the value that the message names.
"#,
};

/// The code.
pub const CODE: Code = Code(&INFO);

/// `message` states the limit, `help` says how to stay within it.
#[must_use]
pub fn hardware_limit(span: Span, message: &str, help: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, message).help(help)
}
