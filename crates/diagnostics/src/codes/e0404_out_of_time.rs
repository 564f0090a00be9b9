//! E0404: time ran out before there was an answer.

use crate::codes::{Code, CodeInfo};
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;

/// The registry entry.
pub const INFO: CodeInfo = CodeInfo {
    code: "E0404",
    severity: Severity::Error,
    title: "time ran out before there was an answer",
    explanation: r#"The search was told to stop (`--timeout`) before it had found a wiring, or proved that there is none.

Way out: give it more time, ask for any wiring (`--any`), or fix some pins.
"#,
};

/// The code.
pub const CODE: Code = Code(&INFO);

/// `span` is the board.
#[must_use]
pub fn out_of_time(span: Span) -> Diagnostic {
    Diagnostic::new(CODE, span, "time ran out before a wiring was found")
        .help("give `--timeout` more seconds, ask for `--any`, or fix some pins")
}
