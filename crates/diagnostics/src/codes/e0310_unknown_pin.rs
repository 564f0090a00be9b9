//! E0310: the board has no such pin.

use super::{Code, CodeInfo, Diagnostic, Span};
use crate::suggest::spelled;

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0310",
    title: "the board has no such pin",
    explanation: r#"The pin is not in the board's table, so nothing is known about it.

Way out: correct the name, or add a row to the table."#,
});

/// `meant` is the nearest pin.
pub fn unknown_pin(span: Span, pin: &str, board: &str, meant: Option<&str>) -> Diagnostic {
    let asked = meant.map(|meant| format!("did you mean `{meant}`?"));
    Diagnostic::new(CODE, span, format!("{board} has no pin {pin}"))
        .here(asked.unwrap_or_default())
        .help("correct the name, or add a row to the board's table")
        .one_of(meant.map(spelled).as_deref())
}
