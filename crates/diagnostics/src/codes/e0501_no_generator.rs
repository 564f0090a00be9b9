//! E0501: this kind cannot be generated yet.

use crate::codes::{Code, CodeInfo};
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;

/// The registry entry.
pub const INFO: CodeInfo = CodeInfo {
    code: "E0501",
    severity: Severity::Error,
    title: "this kind cannot be generated yet",
    explanation: r#"The wiring of every kind is solved, but firmware is generated for some kinds only. Nothing was written, so
that a firmware which reads only some of the devices never looks complete.

Way out: `sensedsl generate --without firmware` writes everything else, the host applications among
it; for firmware, leave the device out of the file.
"#,
};

/// The code.
pub const CODE: Code = Code(&INFO);

/// The device's kind, and the kinds that can be generated.
#[must_use]
pub fn no_generator(span: Span, kind: &str, can: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("no firmware can be generated for {kind} yet"))
        .here(format!("solved, but only {can} can be generated"))
        .help("`generate --without firmware` writes the rest; or leave this device out")
}
