//! E0536: the code of a controller stopped while it ran.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0536",
    title: "the code of a controller stopped while it ran",
    explanation: r#"The code ran as a program on this computer, a step at a time, and gave no answer any more: it crashed, it ended, or a
step took longer than two seconds. On a board the outputs of that controller would take their failsafe values, and the
watchdog would start the board again.

Way out: run it once more with `CFLAGS=-fsanitize=address,undefined`, which says where. Divisions by zero, indices out of range and loops that never
end are the usual reasons."#,
});

/// `why` is a sentence without its end.
pub fn user_code_stopped(span: Span, seconds: &str, why: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("the controllers' code stopped after {seconds}: {why}"))
        .help("run it once more with `CFLAGS=-fsanitize=address,undefined`, which says where")
}
