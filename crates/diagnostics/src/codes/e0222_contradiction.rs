//! E0222: two properties contradict each other.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0222",
    title: "two properties contradict each other",
    explanation: r#"Each of the two is fine alone, but together they ask for something that cannot be.

Way out: change or remove one of them."#,
});

/// `message` says what is impossible; `other` is the other place, with its words.
pub fn contradiction(span: Span, message: &str, other: Span, other_words: &str, help: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, message).here("this").label(other, other_words).help(help)
}
