//! E0104: a semicolon is missing.

use crate::codes::{Code, CodeInfo};
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;

/// The registry entry.
pub const INFO: CodeInfo = CodeInfo {
    code: "E0104",
    severity: Severity::Error,
    title: "a semicolon is missing",
    explanation: r#"Each property and each rule ends with a semicolon, as `id = 17;` does. The mark is just after the
last thing that was understood.

Way out: add `;` there.
"#,
};

/// The code.
pub const CODE: Code = Code(&INFO);

/// `span` is the empty place after the last token.
#[must_use]
pub fn missing_semicolon(span: Span) -> Diagnostic {
    Diagnostic::new(CODE, span, "`;` is missing")
        .here("`;` belongs here")
        .help("end the line with `;`")
        .replace("add `;`", span, ";")
}
