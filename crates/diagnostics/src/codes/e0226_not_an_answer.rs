//! E0226: an earlier answer cannot be read.

use crate::codes::{Code, CodeInfo};
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;

/// The registry entry.
pub const INFO: CodeInfo = CodeInfo {
    code: "E0226",
    severity: Severity::Error,
    title: "an earlier answer cannot be read",
    explanation: r#"`--keep` and `diff` take what `sensedsl solve --format json` has printed, or `assignment.json` of a generated
folder.

Way out: print the answer again, and give the file as it is.
"#,
};

/// The code.
pub const CODE: Code = Code(&INFO);

/// `why` is what is wrong with the file at `path`.
#[must_use]
pub fn not_an_answer(span: Span, path: &str, why: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("{path} is not a JSON answer of `solve`: {why}"))
        .help("print one with `sensedsl solve FILE --format json`")
}
