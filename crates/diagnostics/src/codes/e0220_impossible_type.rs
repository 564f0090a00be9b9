//! E0220: the device cannot give a value of this type.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0220",
    title: "the device cannot give a value of this type",
    explanation: r#"What a device measures or takes decides which value types make sense: a single reading is not an
array unless the protocol reads several elements, and an on/off input is not a `float64`.

Way out: use a type that the message names."#,
});

/// `found` is the type as written, `can` the possible types.
pub fn impossible_type(span: Span, kind: &str, found: &str, can: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("{kind} cannot give {found}"))
        .here(format!("must be {can}"))
        .help(format!("use {can}"))
}
