//! E0547: this program does not include an emulated MCU.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0547",
    title: "this program has no emulated MCU",
    explanation: r#"The MCU that runs an image of firmware is a part of `sensedsl` that is left out unless it is asked for, because it takes
longer to compile than everything else.

Way out: install `sensedsl` with it:

    cargo install --path crates/sensedsl --features twin

Without `--firmware` the board's job runs in this program, which needs nothing."#,
});

/// `--firmware` was given.
pub fn no_machine(span: Span) -> Diagnostic {
    Diagnostic::new(CODE, span, "this sensedsl was built without the emulated MCU")
        .help("install it with `cargo install --path crates/sensedsl --features twin`, or leave `--firmware` out")
}
