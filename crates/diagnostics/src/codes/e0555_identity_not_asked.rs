//! E0555: a part was read without being asked who it is.

use crate::codes::{Code, CodeInfo};
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;

/// The registry entry.
pub const INFO: CodeInfo = CodeInfo {
    code: "E0555",
    severity: Severity::Error,
    title: "a part was not asked who it is",
    explanation: r#"The driver of a part says which register tells it from others (`identity`), and firmware that `generate` makes
reads that register before anything else. In a run of `simulate --judge` the part was read and that register was not:
with another part at the same address, wrong values would be reported as good.

Way out: build the firmware of this very file (`sensedsl build FILE`).
"#,
};

/// The code.
pub const CODE: Code = Code(&INFO);

/// The part's name.
#[must_use]
pub fn not_asked(span: Span, name: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{name}` was read without being asked who it is"))
        .help("another part at the same address would not be noticed: build the firmware of this file with `sensedsl build`")
}
