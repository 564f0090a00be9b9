//! W0610: whether a pin stands a voltage is not known.

use crate::codes::{Code, CodeInfo};
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;

/// The registry entry.
pub const INFO: CodeInfo = CodeInfo {
    code: "W0610",
    severity: Severity::Warning,
    title: "whether a pin stands a voltage is not known",
    explanation: r#"The device puts more than the MCU's supply on its wire, and nothing is known of what the pin stands.

Way out: look the pin up in the MCU's data sheet (FT: it stands 5 V; TT, TTa, TC: it does not). Then write what you found
into the column `Voltage` of the board's table, put a `divider` in between, or say that you know: `allow W0610 "reason";`.
"#,
};

/// The code.
pub const CODE: Code = Code(&INFO);

/// The device, its level and the pin.
#[must_use]
pub fn level_not_known(span: Span, device: &str, level: &str, pin: &str) -> Diagnostic {
    let text = format!("{device} puts {level} on {pin}, and whether that pin stands it is not known");
    Diagnostic::new(CODE, span, text)
        .help("look it up in the MCU's data sheet (FT stands 5 V), or put a `divider` in between")
}
