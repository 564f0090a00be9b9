//! E0103: a comment or a string does not end.

use crate::codes::{Code, CodeInfo};
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;

/// The registry entry.
pub const INFO: CodeInfo = CodeInfo {
    code: "E0103",
    severity: Severity::Error,
    title: "a comment or a string does not end",
    explanation: r#"A `/*` needs its `*/`, and a string ends with `"` on the line on which it begins.

Way out: add the end mark.
"#,
};

/// The code.
pub const CODE: Code = Code(&INFO);

/// `what` is "comment" or "string", `end` its end mark.
#[must_use]
pub fn unterminated(span: Span, what: &str, end: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("this {what} does not end"))
        .here("begins here")
        .help(format!("add `{end}` where it ends"))
}
