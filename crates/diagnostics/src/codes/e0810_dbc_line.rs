//! E0810: a line of a DBC file cannot be read.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0810",
    title: "a line of a DBC file cannot be read",
    explanation: r#"The line begins like one of a DBC file and does not go on like one: something is missing, is not a number, or cannot be
on a CAN bus. Nothing is imported, so that no value is taken from a place that is not its own.

Way out: correct the line, or export the file again from the program that wrote it."#,
});

/// `why` says what is wrong with the line.
pub fn dbc_line(span: Span, why: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, why).here("this line").help("correct the line, or export the file again")
}
