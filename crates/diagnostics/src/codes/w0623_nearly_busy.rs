//! W0623: a part of the hardware is nearly busy.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "W0623",
    title: "a part of the hardware is nearly busy",
    explanation: r#"A converter, a bus, the link or the processor is busy more than 70 % of the time. It works as long as nothing is repeated: a
transfer that fails, a host that is slow or an interrupt more makes values late.

Way out: longer cycle times, or `allow W0623 "reason";`. `sensedsl explain timing FILE` prints what is done part by part."#,
});

/// `part` is what is busy, `percent` how much.
pub fn nearly_busy(span: Span, part: &str, percent: u64) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("{part} is busy {percent} % of the time"))
        .here("most of it comes from here")
        .help("give it longer cycle times; `sensedsl explain timing` says what takes how long")
}
