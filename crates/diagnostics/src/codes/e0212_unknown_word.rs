//! E0212: a property does not know this word.

use crate::codes::{Code, CodeInfo};
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;

/// The registry entry.
pub const INFO: CodeInfo = CodeInfo {
    code: "E0212",
    severity: Severity::Error,
    title: "a property does not know this word",
    explanation: r#"Some properties take one word out of a few, for example `order = big` or `pull = up`.

Way out: use one of the words that the message lists.
"#,
};

/// The code.
pub const CODE: Code = Code(&INFO);

/// `words` lists the possible words.
#[must_use]
pub fn unknown_word(span: Span, name: &str, found: &str, words: &str, meant: Option<&str>) -> Diagnostic {
    let diagnostic = Diagnostic::new(CODE, span, format!("`{name}` cannot be `{found}`"))
        .help(format!("use one of {words}"));
    match meant {
        Some(meant) => diagnostic
            .here(format!("did you mean `{meant}`?"))
            .replace(format!("change to `{meant}`"), span, meant),
        None => diagnostic,
    }
}
