//! E0627: the board cannot make a motor's steps that fast.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0627",
    title: "the board cannot make steps that fast",
    explanation: r#"Each step of a motor is a pulse of its length and a pause, and an interrupt of the processor, which computes when the next
step is due. A `speed` at which pulses would run into each other, or at which the steps of one motor would take more than
70 % of the processor, is refused. The second is known where the instructions of a step were counted
(`sensedsl explain timing FILE` prints them).

Way out: write the `speed` that the message names, or less. A motor driver that is set to fewer microsteps turns the
motor as fast with fewer steps."#,
});

/// `message` says what is asked for and what is possible, `help` what to do.
pub fn too_many_steps(span: Span, message: &str, help: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, message).here("asked here").help(help)
}
