//! E0104: a semicolon is missing.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0104",
    title: "a semicolon is missing",
    explanation: r#"Each property and each rule ends with a semicolon, as `id = 17;` does. The mark is just after the
last thing that was understood.

Way out: add `;` there."#,
});

/// `span` is the empty place after the last token.
pub fn missing_semicolon(span: Span) -> Diagnostic {
    Diagnostic::new(CODE, span, "`;` is missing")
        .here("`;` belongs here")
        .help("end the line with `;`")
        .replace("add `;`", span, ";")
}
