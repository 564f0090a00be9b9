//! E0552: an actuator does not do what the host sets it to.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0552",
    title: "an actuator does not do what it is told",
    explanation: r#"`simulate --judge` sets each actuator to values as a host would: both ends, the middle, both signs, what lies beyond, and
another value for each element of an array. Then it is silent for longer than the link's `silence`, and speaks again.
What comes out of the board (levels, pulses, voltages, bytes to chips, messages, frames) must be what the design says:
in that order, with that scale, on those wires; `initial` before the first command, `failsafe` after the silence.
Levels that no value changes, such as that of a standby input, must be there all the time.

Way out: build the firmware of this very file (`sensedsl build FILE`). If code of yours sets outputs, look at what it does
to the wire that the message names."#,
});

/// `what` says what is wrong at a wire: when, after which command, the expected level and the actual one.
pub fn not_done(span: Span, name: &str, what: &str, wrong: u64, looks: u64) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{name}` does not do what it is told: {what}")).help(format!(
        "{wrong} of {looks} looks at the board's outputs found something else; the table has each of them"
    ))
}

/// A level that no command changes is missing.
pub fn not_there(span: Span, what: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("a level that never changes is wrong: {what}"))
        .help("the part that it is for is off without it; does code of yours set that pin?")
}
