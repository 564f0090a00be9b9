//! E0505: no such host application.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0505",
    title: "no such host application",
    explanation: r#"`--host` names the host applications to generate.

Way out: use the names that the message lists."#,
});

/// `known` lists all hosts.
pub fn unknown_host(span: Span, name: &str, known: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("there is no host application `{name}`"))
        .help(format!("choose from {known}"))
}
