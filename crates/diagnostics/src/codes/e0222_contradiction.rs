//! E0222: two properties contradict each other.

use crate::codes::{Code, CodeInfo};
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;

/// The registry entry.
pub const INFO: CodeInfo = CodeInfo {
    code: "E0222",
    severity: Severity::Error,
    title: "two properties contradict each other",
    explanation: r#"Each of the two is fine alone, but together they ask for something that cannot be.

Way out: change or remove one of them.
"#,
};

/// The code.
pub const CODE: Code = Code(&INFO);

/// `message` says what is impossible; `other` is the other place, with its words.
#[must_use]
pub fn contradiction(span: Span, message: &str, other: Span, other_words: &str, help: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, message).here("this").label(other, other_words).help(help)
}
