//! E0105: a closing brace or bracket is missing.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0105",
    title: "a closing brace or bracket is missing",
    explanation: r#"Each `{` needs its `}`, each `[` its `]` and each `(` its `)`. The second mark shows what was opened.

Way out: add the closing one."#,
});

/// `closing` is `}` or `]`; `opened` is the place of its counterpart.
pub fn missing_closing(span: Span, closing: &str, opened: Option<Span>) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{closing}` is missing"))
        .here(format!("`{closing}` belongs here"))
        .help(format!("close it with `{closing}`"))
        .label(opened, "opened here")
        .replace(format!("add `{closing}`"), Span { end: span.start, ..span }, if closing == "}" { "\n}" } else { closing })
}
