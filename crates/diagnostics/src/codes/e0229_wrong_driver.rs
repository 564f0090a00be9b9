//! E0229: a driver contradicts itself.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0229",
    title: "a driver contradicts itself",
    explanation: r#"A driver says how a part is started and read, as data. This one says something that cannot be: two readings of one
name, a register named twice, an identity that no part can have, a formula without its calibration, a reading over a
connection that there is not.

Way out: the message says what; `sensedsl drivers NAME` shows a driver of the library to compare with."#,
});

/// `message` says what is wrong.
pub fn wrong_driver(span: Span, message: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, message).help("correct it in the driver; `sensedsl drivers NAME` shows how a part of the library does it")
}
