//! E0402: the solver contradicted itself.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0402",
    title: "the solver contradicted itself",
    explanation: r#"The independent checker refused the solver's answer. That is a mistake of the tool, never of the
input; nothing was written.

Way out: report it with the file and the table; `--target none` or a small change of the file may avoid
it meanwhile."#,
});

/// `violation` is what the checker found.
pub fn solver_disagrees(span: Span, violation: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("internal: the answer did not pass its check: {violation}"))
        .help("please report this with the file and the board table")
}
