//! E0310: the board has no such pin.

use crate::codes::{Code, CodeInfo};
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;

/// The registry entry.
pub const INFO: CodeInfo = CodeInfo {
    code: "E0310",
    severity: Severity::Error,
    title: "the board has no such pin",
    explanation: r#"The pin is not in the board's table, so nothing is known about it.

Way out: correct the name, or add a row to the table.
"#,
};

/// The code.
pub const CODE: Code = Code(&INFO);

/// `meant` is the nearest pin.
#[must_use]
pub fn unknown_pin(span: Span, pin: &str, board: &str, meant: Option<&str>) -> Diagnostic {
    let diagnostic = Diagnostic::new(CODE, span, format!("{board} has no pin {pin}"));
    match meant {
        Some(meant) => diagnostic
            .here(format!("did you mean `{meant}`?"))
            .help("correct the name, or add a row to the board's table"),
        None => diagnostic.help("correct the name, or add a row to the board's table"),
    }
}
