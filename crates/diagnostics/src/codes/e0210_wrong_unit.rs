//! E0210: the unit does not fit.

use crate::codes::{Code, CodeInfo};
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;

/// The registry entry.
pub const INFO: CodeInfo = CodeInfo {
    code: "E0210",
    severity: Severity::Error,
    title: "the unit does not fit",
    explanation: r#"Times are written in us, ms or s, frequencies in Hz, kHz or MHz. A bare `delay` is milliseconds.

Way out: use a unit of the right dimension.
"#,
};

/// The code.
pub const CODE: Code = Code(&INFO);

/// `takes` lists the units that fit.
#[must_use]
pub fn wrong_unit(span: Span, name: &str, unit: &str, takes: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{name}` cannot be given in {unit}"))
        .help(format!("use {takes}"))
}
