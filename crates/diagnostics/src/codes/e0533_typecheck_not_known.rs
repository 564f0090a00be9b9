//! E0533: there are no types for a board's MCU.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0533",
    title: "there are no types for this MCU",
    explanation: r#"`check --typecheck` judges a wiring by the types of Embassy's HALs. They cover RP2040, RP2350, nRF52, and of STM32
C0, F0, F1, F3, F4, F7, G0, G4, H5, H7, L0, L1, L4, L5, U0, U5, WB and WL. For another MCU, or a table that does not say
which one it describes, there is nothing to judge by.

Way out: check without `--typecheck`, or name the MCU in the first line of the table: `# mcu = STM32F407VGT6`."#,
});

/// `why` is the reason why there are none for the board.
pub fn not_known(span: Span, board: &str, why: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("the wiring of {board} cannot be type-checked: {why}"))
        .help("check it without `--typecheck`")
}
