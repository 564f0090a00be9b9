//! E0109: a string contains an unknown escape.

use crate::codes::{Code, CodeInfo};
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;

/// The registry entry.
pub const INFO: CodeInfo = CodeInfo {
    code: "E0109",
    severity: Severity::Error,
    title: "a string holds an unknown escape",
    explanation: r#"In a string, `\n`, `\t`, `\"` and `\\` stand for a line break, a tab, a quote and a backslash;
there is no other escape.

Way out: write two backslashes where you mean one.
"#,
};

/// The code.
pub const CODE: Code = Code(&INFO);

/// `escape` is the escape as written.
#[must_use]
pub fn bad_string(span: Span, escape: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{escape}` is not an escape"))
        .help("write two backslashes where you mean one")
}
