//! E0210: the unit does not fit.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0210",
    title: "the unit does not fit",
    explanation: r#"Times are written in us, ms or s, frequencies in Hz, kHz or MHz. A bare `delay` is milliseconds.

Way out: use a unit of the right dimension."#,
});

/// `takes` lists the units that fit.
pub fn wrong_unit(span: Span, name: &str, unit: &str, takes: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{name}` cannot be given in {unit}"))
        .help(format!("use {takes}"))
}
