//! E0621: the hardware cannot keep this cycle time.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0621",
    title: "the hardware cannot keep this cycle time",
    explanation: r#"A converter, a bus, a serial port or the processor has more to do in a cycle than fits into it, alone or together with what
else it serves. The time is computed from the exact clocks, the samples and the bytes of each cycle; `sensedsl explain timing FILE`
prints it part by part.

Way out: write the `delay` that the message names: it is the shortest that can be kept. Fewer samples, a faster bus or another unit help as well."#,
});

/// `message` says what is asked for and what is possible, `help` what to do.
pub fn too_often(span: Span, message: &str, help: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, message).here("asked here").help(help)
}
