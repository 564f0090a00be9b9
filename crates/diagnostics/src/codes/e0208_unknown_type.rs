//! E0208: no such value type.

use crate::codes::{Code, CodeInfo};
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;

/// The registry entry.
pub const INFO: CodeInfo = CodeInfo {
    code: "E0208",
    severity: Severity::Error,
    title: "no such value type",
    explanation: r#"Values are `bool`, `uint8` to `uint64`, `int8` to `int64`, `float32` or `float64`, or an array of one
of them with a length from 1 to 1024: `int16[3]`.

Way out: use one of these.
"#,
};

/// The code.
pub const CODE: Code = Code(&INFO);

/// `meant` is the nearest type name.
#[must_use]
pub fn unknown_type(span: Span, name: &str, meant: Option<&str>) -> Diagnostic {
    let diagnostic = Diagnostic::new(CODE, span, format!("`{name}` is not a value type"))
        .help("use bool, uint8..uint64, int8..int64, float32, float64, or an array such as int16[3]; text is uint8[N]");
    match meant {
        Some(meant) => diagnostic
            .here(format!("did you mean `{meant}`?"))
            .replace(format!("change to `{meant}`"), span, meant),
        None => diagnostic,
    }
}
