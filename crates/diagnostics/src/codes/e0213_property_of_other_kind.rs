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

/// `kinds` lists the kinds that have the property, and `instead` what this kind has in its place.
#[must_use]
pub fn property_of_other_kind(
    span: Span,
    name: &str,
    kind: &str,
    kinds: &str,
    instead: &[&str],
) -> Diagnostic {
    let help = match instead {
        [] => "remove the line, or change the device's `type`".to_owned(),
        words => format!("name each wire: write `{} = …;`", words.join(" = …;` or `")),
    };
    Diagnostic::new(CODE, span, format!("`{name}` means nothing for {kind}"))
        .here(format!("only for {kinds}"))
        .help(help)
}
