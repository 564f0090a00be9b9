//! E0404: time ran out before there was an answer.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0404",
    title: "time ran out before there was an answer",
    explanation: r#"The search was told to stop (`--timeout`) before it had found a wiring, or proved that there is none.

Way out: give it more time, ask for any wiring (`--any`), or fix some pins."#,
});

/// `span` is the board.
pub fn out_of_time(span: Span) -> Diagnostic {
    Diagnostic::new(CODE, span, "time ran out before a wiring was found")
        .help("give `--timeout` more seconds, ask for `--any`, or fix some pins")
}
