//! E0306: a misspelled signal.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0306",
    title: "a misspelled signal",
    explanation: r#"The cell begins like a signal the tool knows, but does not go on like one. Signals are spelled
`ADC12_IN8`, `I2C1_SCL`, `TIM3_CH1`, `USART2_TX`, `SPI1_SCK`, `CAN1_RX`, `DAC1_OUT1`; `-` may stand for `_`.
A usage that the tool does not know at all (`SDIO_D0`) is fine: it counts, and serves nothing.

Way out: correct the spelling."#,
});

/// `found` is the text of the cell at `row` and `column`, `meant` the spelling that was meant.
pub fn table_signal(span: Span, row: usize, column: &str, found: &str, meant: Option<&str>) -> Diagnostic {
    let diagnostic =
        Diagnostic::new(CODE, span, format!("row {row}, column {column}: `{found}` is not a signal"));
    match meant {
        Some(signal) => diagnostic.meant(meant).help(format!("write `{signal}`")),
        None => diagnostic.help("signals are spelled like ADC12_IN8, I2C1_SCL, TIM3_CH1, USART2_TX, SPI1_SCK"),
    }
}
