//! E0550: the firmware has set up a pad or a port differently than planned.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0550",
    title: "a pad or a port that is not set up as planned",
    explanation: r#"`simulate --firmware IMAGE` compares the registers of the pads with the wiring one second after each start: mode, number
of the alternate function, open drain or push-pull, pull-up and pull-down. A pad with another alternate function is led
to another peripheral, and a bus that is driven high by one end and low by the other burns current.

It compares the ports that have started as well: bits per second of serial ports and CAN, bits, parity and stop bits of
a character, clocks of I2C and SPI, the mode of SPI. Two ends that do not agree on these do not understand each other.

Way out: build the firmware of this very file (`sensedsl build FILE`); if code of yours sets up pads or ports, take the
one that the message names out of it."#,
});

/// `found` is how the pad or the port of a device is set up, `expected` how it should be.
pub fn not_as_planned(
    span: Span,
    title: &str,
    place: &str,
    expected: &str,
    found: &str,
    seconds: &str,
) -> Diagnostic {
    let what = format!("{place} of {title} is {found} after {seconds} s, and not {expected}");
    Diagnostic::new(CODE, span, what)
        .help("build the firmware of this file with `sensedsl build`; does code of yours set it up?")
}
