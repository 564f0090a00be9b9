//! E0546: an image of firmware cannot run on the emulated board.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0546",
    title: "firmware that is not for this board",
    explanation: r#"`simulate --firmware IMAGE` runs a program as it would be flashed: an ELF file (`sense.elf`) or a raw image. It must be for
the MCU of the board, and lie where that MCU's flash is.

Way out: build the firmware of this file (`sensedsl build FILE`), and give the program that it names."#,
});

/// The emulated MCU rejects the image; `why` is the reason.
pub fn refused(span: Span, image: &str, why: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("{image} cannot run on this board: {why}"))
        .help("build the firmware of this file with `sensedsl build`, and give the `sense.elf` that it names")
}

/// The MCU cannot be emulated.
pub fn other_mcu(span: Span, board: &str, mcu: &str, known: &str) -> Diagnostic {
    let message = format!("`{board}` has an {mcu}, and only these are emulated: {known}");
    Diagnostic::new(CODE, span, message)
        .help("leave `--firmware` out to run the board's job in this program")
}
