//! E0209: a value of another sort is needed.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0209",
    title: "a value of another sort is needed",
    explanation: r#"A property takes one sort of value: a whole number, a time, a frequency, a name, a text between
quotes, or a list of bytes.

Way out: write a value of the sort that the message names."#,
});

/// `takes` is what the property accepts, with an example; `found` is what is there.
pub fn wrong_value(span: Span, name: &str, takes: &str, found: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{name}` takes {takes}, not {found}"))
        .here(format!("this is {found}"))
        .help(format!("write {takes}"))
}
