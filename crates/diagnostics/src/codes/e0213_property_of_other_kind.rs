//! E0213: the property belongs to another kind.

use crate::codes::{Code, CodeInfo};
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;

/// The registry entry.
pub const INFO: CodeInfo = CodeInfo {
    code: "E0213",
    severity: Severity::Error,
    title: "the property belongs to another kind",
    explanation: r#"The property exists, but not for a device of this kind: an `address` means something to i2c only, a
`baud` to uart only.

Way out: remove the line, or change the device's `type`.
"#,
};

/// The code.
pub const CODE: Code = Code(&INFO);

/// `kinds` lists the kinds that have the property.
#[must_use]
pub fn property_of_other_kind(span: Span, name: &str, kind: &str, kinds: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{name}` means nothing for {kind}"))
        .here(format!("only for {kinds}"))
        .help("remove the line, or change the device's `type`")
}
