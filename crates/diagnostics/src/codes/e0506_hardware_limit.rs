//! E0506: the driver cannot do this.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0506",
    title: "the driver cannot do this",
    explanation: r#"The wiring exists, but the operating system's driver or the peripheral has a limit that the request
exceeds: too many channels in a conversion group, a clock that does not divide, a frequency out of
reach.

Way out: change the value that the message names."#,
});

/// `message` states the limit, `help` says how to stay within it.
pub fn hardware_limit(span: Span, message: &str, help: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, message).help(help)
}
