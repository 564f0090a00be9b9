//! E0561: a configuration of `monitor` names a board or device that does not exist.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0561",
    title: "a configuration names an unknown board or device",
    explanation: r#"In a file for `monitor --config`, `[boards.NAME]` names a board of the design, and `[devices."BOARD/DEVICE"]` a
sensor or actuator of one of its boards.

Way out: write a name that the design has; the message has the nearest one, or all of them."#,
});

/// `sort` is `board` or `device`; `all` lists what there is.
pub fn unknown_name(span: Span, sort: &str, name: &str, near: Option<&str>, all: &str) -> Diagnostic {
    let what = format!("the design has no {sort} called `{name}`");
    let report = Diagnostic::new(CODE, span, what).here("unknown");
    match near {
        Some(near) => report.help(format!("did you mean `{near}`?")),
        None => report.help(format!("there are {all}")),
    }
}
