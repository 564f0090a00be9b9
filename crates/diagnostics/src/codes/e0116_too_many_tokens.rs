//! E0116: a design is too long.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0116",
    title: "a design is too long",
    explanation: r#"The words, numbers, signs, spaces and comments of a design are counted over all its files. A design has at
most 254 devices, for which a few thousand are enough; `docs/limits.md` has the limit.

Way out: take out what does not belong to the design."#,
});

/// `most` is the greatest number allowed.
pub fn too_many_tokens(span: Span, most: usize) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("the design has more than {most} words, signs and spaces"))
        .here("the text is not read from here on")
        .help("name the file that is meant, or take out what does not belong to the design")
}
