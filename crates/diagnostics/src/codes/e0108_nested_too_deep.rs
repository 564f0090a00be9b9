//! E0108: lists are nested too deep.

use crate::codes::{Code, CodeInfo};
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;

/// The registry entry.
pub const INFO: CodeInfo = CodeInfo {
    code: "E0108",
    severity: Severity::Error,
    title: "lists are nested too deep",
    explanation: r#"Lists may contain lists, but no property needs more than a few levels; anything deeper is taken for a
typing mistake.

Way out: remove brackets.
"#,
};

/// The code.
pub const CODE: Code = Code(&INFO);

/// `most` is the depth that is still read.
#[must_use]
pub fn nested_too_deep(span: Span, most: usize) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("lists are nested more than {most} deep"))
        .help("remove brackets: no property takes more than a list of numbers")
}
