//! E0205: two names become one in generated code.

use crate::codes::{Code, CodeInfo};
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;

/// The registry entry.
pub const INFO: CodeInfo = CodeInfo {
    code: "E0205",
    severity: Severity::Error,
    title: "two names become one in generated code",
    explanation: r#"Generated code spells names in the manner of its language: `IRFront` becomes `IR_FRONT` for a C
constant and `ir_front` for a Python variable. Two names that differ only in case or in underscores
become the same there.

Way out: rename one of them so that they differ in letters or digits.
"#,
};

/// The code.
pub const CODE: Code = Code(&INFO);

/// `form` is the spelling in which both are equal.
#[must_use]
pub fn clashing_names(span: Span, name: &str, other: &str, form: &str, first: Span) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{name}` and `{other}` both become `{form}` in generated code"))
        .here("clashes")
        .label(first, format!("with `{other}`"))
        .help("rename one so that they differ in more than case and underscores")
}
