//! H0702: the MCU of the table is not known.

use crate::codes::{Code, CodeInfo};
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;

/// The registry entry.
pub const INFO: CodeInfo = CodeInfo {
    code: "H0702",
    severity: Severity::Hint,
    title: "the MCU of the table is not known",
    explanation: r#"Nothing says which MCU the table describes, so only the pins are looked at: timers, DMA streams,
interrupt lines and drivers are not.

Way out: begin the table with a line such as `# mcu = STM32F407VGT6`.
"#,
};

const CODE: Code = Code(&INFO);

/// Why there is no target.
#[must_use]
pub fn target_none(span: Span, table: &str, why: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("only the pins of {table} are looked at: {why}"))
        .help("begin the table with a line such as `# mcu = STM32F407VGT6`")
}
