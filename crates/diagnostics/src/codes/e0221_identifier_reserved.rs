//! E0221: the name cannot be used.

use crate::codes::{Code, CodeInfo};
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;

/// The registry entry.
pub const INFO: CodeInfo = CodeInfo {
    code: "E0221",
    severity: Severity::Error,
    title: "the name cannot be used",
    explanation: r#"Names become identifiers in generated code and files on disk: they begin with a letter, have letters,
digits and underscores, and at most 63 of them.

Way out: choose another name.
"#,
};

/// The code.
pub const CODE: Code = Code(&INFO);

/// `why` is the reason why the name cannot be used.
#[must_use]
pub fn identifier_reserved(span: Span, name: &str, why: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{name}` cannot be a name: {why}"))
        .help("begin with a letter; use letters, digits and `_`, at most 63")
}
