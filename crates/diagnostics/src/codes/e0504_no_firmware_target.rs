//! E0504: no firmware for this board.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0504",
    title: "no firmware for this board",
    explanation: r#"Firmware needs a target that serves the board's MCU. A table of your own says which MCU it describes by a
first line such as `# mcu = STM32F407VGT6`. ChibiOS must have a board with the MCU in its tree; Embassy's HAL must
know the MCU; the timer that its clock runs on is left free by the wiring (E0401 where none can be). What a single
device needs and the target's profile or the wiring does not have is told with the device's name: a unit, a pin, an
interrupt, a DMA stream.

Way out: say which MCU the table describes; take the other target (`--target embassy`, `--target chibios`); or take
another pin or unit for the device that is named. `sensedsl generate --without firmware` writes everything else, the
host applications among it."#,
});

/// `why` is the reason why there is no firmware for the board.
pub fn no_firmware_target(span: Span, board: &str, why: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("no firmware can be generated for {board}: {why}"))
        .help("`generate --without firmware` writes the rest")
}
