//! E0529: Wokwi does not have the board.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0529",
    title: "Wokwi does not have the board",
    explanation: r#"`solve --format wokwi` writes a diagram for Wokwi, a simulator in the browser, in which every part is one that Wokwi
draws. It has no part for this board, or the board is a table or an MCU of your own, so there would be nothing to
connect the wires to.

Way out: put the design on one of the boards that the message lists, or take another picture: `--format svg` draws any
board, and `--format markdown` is the wiring sheet."#,
});

/// `board` is the name in the design, `known` the boards that Wokwi has.
pub fn no_wokwi_board(span: Span, board: &str, known: &[String]) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("Wokwi has no part for the board `{board}`"))
        .help(format!("take one that it has ({}), or draw this one with `--format svg`", known.join(", ")))
}
