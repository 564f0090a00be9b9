//! E0221: the name cannot be used.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0221",
    title: "the name cannot be used",
    explanation: r#"Names become identifiers in generated code and files on disk: they begin with a letter, have letters,
digits and underscores, and at most 63 of them.

Way out: choose another name."#,
});

/// `why` is the reason why the name cannot be used.
pub fn identifier_reserved(span: Span, name: &str, why: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{name}` cannot be a name: {why}"))
        .help("begin with a letter; use letters, digits and `_`, at most 63")
}
