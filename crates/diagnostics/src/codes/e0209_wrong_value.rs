//! E0209: a value of another sort is needed.

use crate::codes::{Code, CodeInfo};
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;

/// The registry entry.
pub const INFO: CodeInfo = CodeInfo {
    code: "E0209",
    severity: Severity::Error,
    title: "a value of another sort is needed",
    explanation: r#"A property takes one sort of value: a whole number, a time, a frequency, a name, a text between
quotes, or a list of bytes.

Way out: write a value of the sort that the message names.
"#,
};

/// The code.
pub const CODE: Code = Code(&INFO);

/// `takes` is what the property accepts, with an example; `found` is what is there.
#[must_use]
pub fn wrong_value(span: Span, name: &str, takes: &str, found: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{name}` takes {takes}, not {found}"))
        .here(format!("this is {found}"))
        .help(format!("write {takes}"))
}
