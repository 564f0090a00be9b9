//! W0607: a part is not fully known.

use crate::codes::{Code, CodeInfo};
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;

/// The registry entry.
pub const INFO: CodeInfo = CodeInfo {
    code: "W0607",
    severity: Severity::Warning,
    title: "a part is not known in full",
    explanation: r#"The board is a bare MCU part of which not all is known: its package, so that a pin may not be brought out;
the places of its pins; or which of several packages is meant, so that only pins that all of them have are
offered.

Way out: write the whole part number, or make a board table from `sensedsl parts --table NAME`.
"#,
};

/// The code.
pub const CODE: Code = Code(&INFO);

/// `what` is what is not known.
#[must_use]
pub fn part_not_certain(span: Span, what: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, what)
        .help("write the whole part number, or make a board table of the part")
}
