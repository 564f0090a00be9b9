//! E0107: probably a misspelled keyword.

use crate::codes::{Code, CodeInfo};
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;

/// The registry entry.
pub const INFO: CodeInfo = CodeInfo {
    code: "E0107",
    severity: Severity::Error,
    title: "probably a misspelled keyword",
    explanation: r#"Only a few words are possible here, and this one is nearly one of them.

Way out: correct the spelling.
"#,
};

/// The code.
pub const CODE: Code = Code(&INFO);

/// `found` is the word as written, `meant` the keyword that was meant.
#[must_use]
pub fn misspelled_keyword(span: Span, found: &str, meant: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{found}` is not a keyword"))
        .here(format!("did you mean `{meant}`?"))
        .help(format!("write `{meant}`"))
        .replace(format!("change to `{meant}`"), span, meant)
}
