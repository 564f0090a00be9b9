//! E0405: more wires would have to move than allowed.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0405",
    title: "more wires would have to move than allowed",
    explanation: r#"With `--keep` the wiring that moves the fewest wires is found, and with `--max-moves` one that moves more
than that is refused: the message says how many the fewest is.

Way out: allow that many moves, or drop what makes them necessary."#,
});

/// `moved` is the least possible number of moves, `most` the number allowed.
pub fn too_many_moves(span: Span, moved: u32, most: u32) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("at least {moved} wires have to move, {most} are allowed"))
        .help(format!("allow them with `--max-moves {moved}`, or drop what makes them necessary"))
}
