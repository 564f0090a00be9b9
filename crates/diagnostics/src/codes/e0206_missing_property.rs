//! E0206: a required property is missing.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0206",
    title: "a required property is missing",
    explanation: r#"Every device needs `id` and `type`, an i2c device also `address`, and so on; the language reference
marks what is required.

Way out: add the line."#,
});

/// `of` describes the owner; `example` is a line that would be valid.
pub fn missing_property(span: Span, name: &str, of: &str, example: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("{of} needs `{name}`"))
        .here(format!("`{name}` is missing"))
        .help(format!("add a line such as `{example}`"))
        .add(span, example)
}
