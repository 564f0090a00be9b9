//! E0103: a comment or a string does not end.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0103",
    title: "a comment or a string does not end",
    explanation: r#"A `/*` needs its `*/`, and a string ends with `"` on the line on which it begins.

Way out: add the end mark."#,
});

/// `what` is "comment" or "string", `end` its end mark.
pub fn unterminated(span: Span, what: &str, end: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("this {what} does not end"))
        .here("begins here")
        .help(format!("add `{end}` where it ends"))
}
