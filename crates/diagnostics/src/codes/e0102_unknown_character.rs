//! E0102: a character that means nothing here.

use super::{Code, CodeInfo, Diagnostic, Span};
use crate::visible::visible;

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0102",
    title: "a character that means nothing here",
    explanation: r#"The language is written with letters, digits and `{ } [ ] ( ) = ; , + - * / . " _`. Other characters
are allowed only in comments and strings; they often come from copying out of a document (typographic
quotes, non-breaking spaces), or from another language: a comment begins with `//` here, not with `#`,
and a property is `name = value;`, without a colon.

Way out: remove the character, write what this language has for it, or put the text between straight
quotes."#,
});

/// `found` is the character as it is in the text.
pub fn unknown_character(span: Span, found: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{}` means nothing here", visible(found)))
        .help("remove it; text belongs between straight quotes or in a comment")
        .replace("remove it", span, if found.chars().all(char::is_whitespace) { " " } else { "" })
}

/// A `#` and the rest of its line, meant as a comment.
pub fn comment_with_hash(span: Span) -> Diagnostic {
    let hash = Span { end: span.start + 1, ..span };
    Diagnostic::new(CODE, span, "`#` does not begin a comment")
        .here("write `//` instead of `#`")
        .help("begin a comment with `//`")
        .replace("change to `//`", hash, "//")
}

/// A `:` instead of `=`.
pub fn colon(span: Span) -> Diagnostic {
    Diagnostic::new(CODE, span, "`:` means nothing here")
        .here("write `=`")
        .help("write a property as `name = value;`")
        .replace("change to `=`", span, "=")
}

/// A `:` between two numbers.
pub fn range_with_colon(span: Span) -> Diagnostic {
    Diagnostic::new(CODE, span, "`:` means nothing here")
        .here("write `..`")
        .help("write a range with two dots, such as `31..18`")
        .replace("change to `..`", span, "..")
}

/// A character of a unit, which has another spelling here.
pub fn of_unit(span: Span, found: char, spelling: &str) -> Diagnostic {
    let units = "units are written with plain letters: `degC`, `deg`, `us`, `Ohm`; a `quantity` that has more than \
                 letters stands between quotes: `quantity = \"m/s^2\";`";
    Diagnostic::new(CODE, span, format!("`{found}` means nothing here"))
        .here(format!("write `{spelling}`"))
        .help(units)
        .replace(format!("change to `{spelling}`"), span, spelling)
}

/// The single character that word processors make out of three dots.
pub fn ellipsis(span: Span) -> Diagnostic {
    Diagnostic::new(CODE, span, "`…` means nothing here")
        .here("write `..`")
        .help("write a range as `1..5`")
        .replace("change to `..`", span, "..")
}

/// A text between quotes that are not `"`.
pub fn other_quotes(span: Span) -> Diagnostic {
    Diagnostic::new(CODE, span, "text is written between straight double quotes")
        .here("these are other quotes")
        .help("write it as `\"text\"`")
}
