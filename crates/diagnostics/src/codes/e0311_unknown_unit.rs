//! E0311: the board has no such peripheral.

use crate::codes::{Code, CodeInfo};
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;

/// The registry entry.
pub const INFO: CodeInfo = CodeInfo {
    code: "E0311",
    severity: Severity::Error,
    title: "the board has no such peripheral",
    explanation: r#"`unit` names a peripheral instance such as ADC1, I2C2 or TIM3 that the board's table has and that
this kind of device can use.

Way out: use one of the units that the message lists.
"#,
};

/// The code.
pub const CODE: Code = Code(&INFO);

/// `units` lists the units that exist for this kind.
#[must_use]
pub fn unknown_unit(span: Span, unit: &str, kind: &str, units: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{unit}` cannot serve {kind}"))
        .help(if units.is_empty() {
            format!("the board has nothing for {kind}")
        } else {
            format!("use one of {units}")
        })
}
