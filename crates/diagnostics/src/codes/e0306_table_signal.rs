//! E0306: a misspelled signal.

use crate::codes::{Code, CodeInfo};
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;

/// The registry entry.
pub const INFO: CodeInfo = CodeInfo {
    code: "E0306",
    severity: Severity::Error,
    title: "a misspelled signal",
    explanation: r#"The cell begins like a signal the tool knows, but does not go on like one. Signals are spelled
`ADC12_IN8`, `I2C1_SCL`, `TIM3_CH1`, `USART2_TX`, `SPI1_SCK`, `CAN1_RX`, `DAC1_OUT1`; `-` may stand for `_`.
A usage that the tool does not know at all (`SDIO_D0`) is fine: it counts, and serves nothing.

Way out: correct the spelling.
"#,
};

/// The code.
pub const CODE: Code = Code(&INFO);

/// `found` is the text of the cell at `row` and `column`, `meant` the spelling that was meant.
#[must_use]
pub fn table_signal(span: Span, row: usize, column: &str, found: &str, meant: Option<&str>) -> Diagnostic {
    let diagnostic =
        Diagnostic::new(CODE, span, format!("row {row}, column {column}: `{found}` is not a signal"));
    match meant {
        Some(meant) => diagnostic
            .here(format!("did you mean `{meant}`?"))
            .help(format!("write `{meant}`"))
            .replace(format!("change to `{meant}`"), span, meant),
        None => diagnostic.help("signals are spelled like ADC12_IN8, I2C1_SCL, TIM3_CH1, USART2_TX, SPI1_SCK"),
    }
}
