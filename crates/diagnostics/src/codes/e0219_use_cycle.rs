//! E0219: files use each other in a circle.

use crate::codes::{Code, CodeInfo};
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;

/// The registry entry.
pub const INFO: CodeInfo = CodeInfo {
    code: "E0219",
    severity: Severity::Error,
    title: "files use each other in a circle",
    explanation: r#"A file may use another one only if that does not, directly or by others, use the first.

Way out: move what both need into a third file.
"#,
};

/// The code.
pub const CODE: Code = Code(&INFO);

/// `circle` lists the files of the circle, in order.
#[must_use]
pub fn use_cycle(span: Span, circle: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("these files use each other in a circle: {circle}"))
        .help("move what both need into a third file")
}
