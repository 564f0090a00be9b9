//! E0303: a board table has nothing to offer.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0303",
    title: "a board table has nothing to offer",
    explanation: r#"A board table has a head with the column `Pin`, and a row for each pin:

    Pin,ADC,I2C,ICU
    PA1,ADC123-IN1,-,TIM2_CH2 TIM5_CH2

Way out: add what is missing."#,
});

/// `missing` is what is missing ("the column `Pin`", "rows").
pub fn table_empty(span: Span, missing: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("the table lacks {missing}"))
        .help("a table has a head with the column `Pin` and a row for each pin")
}
