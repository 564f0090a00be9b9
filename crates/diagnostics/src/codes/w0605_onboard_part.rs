//! W0605: the wiring touches an on-board part.

use crate::codes::{Code, CodeInfo};
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;

/// The registry entry.
pub const INFO: CodeInfo = CodeInfo {
    code: "W0605",
    severity: Severity::Warning,
    title: "the wiring touches an on-board part",
    explanation: r#"The pin also leads to a part that is soldered to the board. The table says that it may be used all the
same; the part may disturb the signal, or be disturbed.

Way out: look at the board's schematic, `reserve` the pin if it must not be used, or say that you know:
`allow W0605 "reason";`.
"#,
};

const CODE: Code = Code(&INFO);

/// The device, the pin and the part.
#[must_use]
pub fn onboard_part(span: Span, device: &str, pin: &str, part: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("{device} is on {pin}, which the board also connects to {part}"))
        .help(format!("`reserve {pin};` if it must stay free"))
}
