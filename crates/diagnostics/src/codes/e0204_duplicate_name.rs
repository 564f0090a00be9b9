//! E0204: a name is used twice.

use crate::codes::{Code, CodeInfo};
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;

/// The registry entry.
pub const INFO: CodeInfo = CodeInfo {
    code: "E0204",
    severity: Severity::Error,
    title: "a name is used twice",
    explanation: r#"Boards, devices and drivers each need a name of their own: it is what the generated code, the
messages and the wiring sheet call them.

Way out: rename one of them.
"#,
};

/// The code.
pub const CODE: Code = Code(&INFO);

/// `what` is "board", "device" or "driver".
#[must_use]
pub fn duplicate_name(span: Span, what: &str, name: &str, first: Span) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("the {what} `{name}` exists already"))
        .here("the same name again")
        .label(first, "first here")
        .help("rename one of the two")
}
