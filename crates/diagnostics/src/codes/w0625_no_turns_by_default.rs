//! W0625: rangers of one board measure at the same time.

use crate::codes::{Code, CodeInfo};
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;

/// The registry entry.
pub const INFO: CodeInfo = CodeInfo {
    code: "W0625",
    severity: Severity::Warning,
    title: "rangers of one board measure at the same time",
    explanation: r#"The rangers of the library are in group `ultrasonic`, because they hear each other. At these cycle times they cannot take
turns, so they measure at the same time, and one may report the echo of another.

Way out: give all of them the cycle time that the message names. Where they face away from each other, write `group = none;` or `allow W0625 "reason";`.
"#,
};

/// The code.
pub const CODE: Code = Code(&INFO);

/// `device` gets no turn; `all_ms` is how long all of them take one after the other.
#[must_use]
pub fn no_turns(span: Span, device: &str, group: &str, count: usize, all_ms: u32) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("{device} measures at the same time as others of group {group}: its {count} devices take {all_ms} ms together"))
        .help(format!("write `delay = {all_ms} ms;` or more for all {count}, and they take turns; or `group = none;`"))
}
