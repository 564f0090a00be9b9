//! E0212: a property does not know this word.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0212",
    title: "a property does not know this word",
    explanation: r#"Some properties take one word out of a few, for example `order = big` or `pull = up`.

Way out: use one of the words that the message lists."#,
});

/// `words` lists the possible words.
pub fn unknown_word(span: Span, name: &str, found: &str, words: &str, meant: Option<&str>) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{name}` cannot be `{found}`"))
        .help(format!("use one of {words}"))
        .meant(meant)
}
