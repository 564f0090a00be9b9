//! W0615: the target has no firmware for this.

use super::{Code, CodeInfo, Diagnostic};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "W0615",
    title: "the target has no firmware for this",
    explanation: r#"There is a wiring, but `sensedsl generate` will refuse the file: the board's target has no code for this device on
its MCU, or the MCU cannot do what the code needs. The message ends with the code under which `generate` refuses it.

Way out: take another target or another board, or leave the device out. Where you write the firmware yourself,
`generate --without firmware` writes everything else; `allow W0615 "own firmware";` in the device or the board says so."#,
});

/// The gap that `generate` would report, as a warning for users who do not generate yet.
pub fn no_firmware(gap: Diagnostic, target: &str) -> Diagnostic {
    let message = format!("target {target}: {} ({})", gap.message, gap.code);
    let mut warning = Diagnostic::new(CODE, gap.primary.span, message);
    warning.primary.message = gap.primary.message;
    warning.labels = gap.labels;
    warning.help = gap.help;
    warning
}
