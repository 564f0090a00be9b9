//! E0303: a board table has nothing to offer.

use crate::codes::{Code, CodeInfo};
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;

/// The registry entry.
pub const INFO: CodeInfo = CodeInfo {
    code: "E0303",
    severity: Severity::Error,
    title: "a board table has nothing to offer",
    explanation: r#"A board table has a head with the column `Pin`, and a row for each pin:

    Pin,ADC,I2C,ICU
    PA1,ADC123-IN1,-,TIM2_CH2 TIM5_CH2

Way out: add what is missing.
"#,
};

/// The code.
pub const CODE: Code = Code(&INFO);

/// `missing` is what is missing ("the column `Pin`", "rows").
#[must_use]
pub fn table_empty(span: Span, missing: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("the table lacks {missing}"))
        .help("a table has a head with the column `Pin` and a row for each pin")
}
