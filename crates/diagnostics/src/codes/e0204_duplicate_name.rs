//! E0204: a name is used twice.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0204",
    title: "a name is used twice",
    explanation: r#"Boards, devices and drivers each need a name of their own: it is what the generated code, the
messages and the wiring sheet call them.

Way out: rename one of them."#,
});

/// `what` is "board", "device" or "driver", `free` a name that is not in use.
pub fn duplicate_name(span: Span, what: &str, name: &str, first: Span, free: Option<&str>) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("the {what} `{name}` exists already"))
        .here("the same name again")
        .label(first, "first here")
        .help("rename one of the two")
        .one_of(free)
}
