//! E0107: probably a misspelled keyword.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0107",
    title: "probably a misspelled keyword",
    explanation: r#"Only a few words are possible here, and this one is nearly one of them.

Way out: correct the spelling."#,
});

/// `found` is the word as written, `meant` the keyword that was meant.
pub fn misspelled_keyword(span: Span, found: &str, meant: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{found}` is not a keyword"))
        .here(format!("did you mean `{meant}`?"))
        .help(format!("write `{meant}`"))
        .replace(format!("change to `{meant}`"), span, meant)
}
