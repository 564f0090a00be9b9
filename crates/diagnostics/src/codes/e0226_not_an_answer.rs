//! E0226: an earlier answer cannot be read.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0226",
    title: "an earlier answer cannot be read",
    explanation: r#"`--keep` and `diff` take what `sensedsl solve --format json` has printed, or `assignment.json` of a generated
folder.

Way out: print the answer again, and give the file as it is."#,
});

/// `why` is what is wrong with the file at `path`.
pub fn not_an_answer(span: Span, path: &str, why: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("{path} is not a JSON answer of `solve`: {why}"))
        .help("print one with `sensedsl solve FILE --format json`")
}
