//! E0549: reports disagree with the world.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0549",
    title: "reports disagree with the world",
    explanation: r#"`simulate --judge` compares every report with the world: what a device reports must lie within what the world did since
the measurement can have been made, give or take what hardware and coding round. A device disagrees as well that reports
nothing for longer than three of its cycles, unless the world explains it, or whose reports come more than 10 % too
often or too rarely; and one that the board says has failed, with nothing wrong in the world.

Values of another scale, order or device, old values, lost ones and wrong addresses are found this way.

Way out: look at the device that the message names; the table before it has them all."#,
});

/// `what` is the worst disagreement, in words.
pub fn disagrees(span: Span, name: &str, what: &str, wrong: u64, all: u64) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{name}` disagrees with the world: {what}"))
        .help(format!("{wrong} findings in {all} reports of the board's sensors; the table has each of them"))
}

/// Nothing was reported at all.
pub fn silent(span: Span) -> Diagnostic {
    Diagnostic::new(CODE, span, "the board has reported nothing")
        .help("simulate for longer: `--seconds 10`; a board without sensors has nothing to report")
}
