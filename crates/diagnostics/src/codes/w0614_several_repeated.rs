//! W0614: several commands of one part are repeated.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "W0614",
    title: "several commands of one part are repeated",
    explanation: r#"With `resend` a frame is sent again and again once it was commanded. A part that has several ways to be commanded, such
as a motor controller with a duty cycle, a current and a speed, obeys the frame that came last: two that are both
repeated take turns, and the motor jerks.

Way out: keep only the command that you use, or let no more than one of them repeat; where the part does want all of
them, say so: `allow W0614 "four wheels, four frames";`."#,
});

/// `commands` lists the repeated commands of the part.
pub fn several_repeated(span: Span, part: &str, commands: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("{part} repeats several commands: {commands}"))
        .here("these go on side by side once each was set")
        .help("list only the command that you use in the chip, or remove `resend`")
}
