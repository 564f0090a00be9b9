//! E0208: no such value type.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0208",
    title: "no such value type",
    explanation: r#"Values are `bool`, `uint8` to `uint64`, `int8` to `int64`, `float32` or `float64`, or an array of one
of them with a length from 1 to 1024: `int16[3]`.

Way out: use one of these."#,
});

/// `meant` is the nearest type name.
pub fn unknown_type(span: Span, name: &str, meant: Option<&str>) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{name}` is not a value type"))
        .help("use bool, uint8..uint64, int8..int64, float32, float64, or an array such as int16[3]; text is uint8[N]")
        .meant(meant)
}
