//! E0505: no such host application.

use crate::codes::{Code, CodeInfo};
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;

/// The registry entry.
pub const INFO: CodeInfo = CodeInfo {
    code: "E0505",
    severity: Severity::Error,
    title: "no such host application",
    explanation: r#"`--host` names the host applications to generate.

Way out: use the names that the message lists.
"#,
};

/// The code.
pub const CODE: Code = Code(&INFO);

/// `known` lists all hosts.
#[must_use]
pub fn unknown_host(span: Span, name: &str, known: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("there is no host application `{name}`"))
        .help(format!("choose from {known}"))
}
