//! E0620: the hardware cannot make this clock.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0620",
    title: "the hardware cannot make this clock",
    explanation: r#"A peripheral divides its clock by whole numbers within limits. What is asked for cannot be had: a bus slower than the
greatest divider makes, a serial rate that the divider misses by more than 2.2 %, a timer's tick that is off by more than a thousandth,
a sampling time that the converter does not have. A program with such a value would not build, halt the board, or talk past the device.

Way out: write the value that the message names. `sensedsl explain timing FILE` shows the exact clocks."#,
});

/// `message` says what is asked for and what is possible, `help` what to do.
pub fn clock_out_of_reach(span: Span, message: &str, help: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, message).help(help)
}
