//! E0530: the compiler refuses a wire.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0530",
    title: "the compiler refuses a wire",
    explanation: r#"`check --typecheck` writes each wire as a line of Rust and lets the compiler judge it by the types of Embassy's
HAL, which other people make from ST's data: which pins a unit's signal has, which DMA streams serve it, that nothing is
taken twice. Here they refuse a wire that the solver chose.

Way out: look the pin up in the data sheet. Where a table of your own is wrong, correct it. Where the table is
right, one of the two tools is not: please report it, with the file and this message."#,
});

/// `wire` is the wire, `why` the compiler's message.
pub fn refused(span: Span, wire: &str, why: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("the compiler refuses {wire}"))
        .here(why.to_owned())
        .help("look the pin up in the data sheet: either the board's table or one of the tools is wrong")
}
