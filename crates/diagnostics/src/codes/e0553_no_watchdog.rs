//! E0553: the firmware runs without its watchdog.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0553",
    title: "the watchdog does not run",
    explanation: r#"Firmware that `generate` makes starts the MCU's watchdog, which resets a board whose program hangs.
`simulate --firmware IMAGE` looks for it one second after each start: it must run, and bite within ten seconds.

Way out: build the firmware of this very file (`sensedsl build FILE`), and leave the watchdog's registers to it."#,
});

/// `found` is the state of the watchdog, `seconds` the time.
pub fn no_watchdog(span: Span, found: &str, seconds: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("the watchdog {found} after {seconds} s"))
        .help("a program that hangs would hang for ever: build the firmware of this file with `sensedsl build`; `make` alone builds for development, without a watchdog")
}
