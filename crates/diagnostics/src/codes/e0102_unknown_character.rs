//! E0102: a character that means nothing here.

use crate::codes::{Code, CodeInfo};
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;
use crate::visible::visible;

/// The registry entry.
pub const INFO: CodeInfo = CodeInfo {
    code: "E0102",
    severity: Severity::Error,
    title: "a character that means nothing here",
    explanation: r#"The language is written with letters, digits and `{ } [ ] = ; , + - . " / _`. Other characters are
allowed only in comments and strings; they often come from copying out of a document (typographic
quotes, non-breaking spaces).

Way out: remove the character, or put the text between straight quotes.
"#,
};

/// The code.
pub const CODE: Code = Code(&INFO);

/// The character as it stands in the text.
#[must_use]
pub fn unknown_character(span: Span, found: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{}` means nothing here", visible(found)))
        .help("remove it; text belongs between straight quotes or in a comment")
}
