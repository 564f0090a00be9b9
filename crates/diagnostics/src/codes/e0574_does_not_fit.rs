//! E0574: the firmware needs more memory than the MCU has.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0574",
    title: "the firmware does not fit",
    explanation: r#"The MCU has less memory than the firmware takes: values, frames, the state of parts, buffers of ports, and what the
framework keeps for itself. The message names the three parts that take most; README.md of a generated sketch has all of
them. An Arduino Uno has 2048 bytes of RAM, of which the stack needs some 250.

Way out: report fewer devices or smaller types, leave parts out, give a serial device's message an end that comes
sooner, or take an MCU with more memory: a Mega 2560 has four times as much RAM."#,
});

/// `what` is the memory, `bytes` what is needed and what there is, `largest` what takes most, with its bytes.
pub fn does_not_fit(
    span: Span,
    board: &str,
    what: &str,
    (needed, room): (u32, u32),
    largest: &[(&str, u32)],
) -> Diagnostic {
    let message = format!("{board} needs {needed} bytes of {what}, and its MCU has {room}");
    let largest: Vec<String> =
        largest.iter().map(|(what, bytes)| format!("{what} ({bytes} bytes)")).collect();
    Diagnostic::new(CODE, span, message)
        .help(format!("most of it is taken by {}", largest.join(", ")))
}
