//! E0109: a string contains an unknown escape.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0109",
    title: "a string holds an unknown escape",
    explanation: r#"In a string, `\n`, `\t`, `\"` and `\\` stand for a line break, a tab, a quote and a backslash;
there is no other escape.

Way out: write two backslashes where you mean one."#,
});

/// `escape` is the escape as written.
pub fn bad_string(span: Span, escape: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{escape}` is not an escape"))
        .help("write two backslashes where you mean one")
}
