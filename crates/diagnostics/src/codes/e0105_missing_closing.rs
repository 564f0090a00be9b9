//! E0105: a closing brace or bracket is missing.

use crate::codes::{Code, CodeInfo};
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;

/// The registry entry.
pub const INFO: CodeInfo = CodeInfo {
    code: "E0105",
    severity: Severity::Error,
    title: "a closing brace or bracket is missing",
    explanation: r#"Each `{` needs its `}`, each `[` its `]` and each `(` its `)`. The second mark shows what was opened.

Way out: add the closing one.
"#,
};

/// The code.
pub const CODE: Code = Code(&INFO);

/// `closing` is `}` or `]`; `opened` is the place of its counterpart.
#[must_use]
pub fn missing_closing(span: Span, closing: &str, opened: Option<Span>) -> Diagnostic {
    let diagnostic = Diagnostic::new(CODE, span, format!("`{closing}` is missing"))
        .here(format!("`{closing}` belongs here"))
        .help(format!("close it with `{closing}`"));
    match opened {
        Some(opened) => diagnostic.label(opened, "opened here"),
        None => diagnostic,
    }
}
