//! E0206: a required property is missing.

use crate::codes::{Code, CodeInfo};
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;

/// The registry entry.
pub const INFO: CodeInfo = CodeInfo {
    code: "E0206",
    severity: Severity::Error,
    title: "a required property is missing",
    explanation: r#"Every device needs `id` and `type`, an i2c device also `address`, and so on; the language reference
marks what is required.

Way out: add the line.
"#,
};

/// The code.
pub const CODE: Code = Code(&INFO);

/// `of` describes the owner; `example` is a line that would be valid.
#[must_use]
pub fn missing_property(span: Span, name: &str, of: &str, example: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("{of} needs `{name}`"))
        .here(format!("`{name}` is missing"))
        .help(format!("add a line such as `{example}`"))
}
