//! E0624: the devices of a group cannot take turns.

use crate::codes::{Code, CodeInfo};
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;

/// The registry entry.
pub const INFO: CodeInfo = CodeInfo {
    code: "E0624",
    severity: Severity::Error,
    title: "the devices of a group cannot take turns",
    explanation: r#"Devices of one group never measure at the same time. Each keeps its cycle time, so their measurements must fit into it one
after the other; with different cycle times, into the greatest time that divides both.

Way out: give all of them the cycle time that the message names, or leave a device out of the group (`group = none;`).
"#,
};

/// The code.
pub const CODE: Code = Code(&INFO);

/// `device` gets no turn; `all_ms` is how long all of them take one after the other.
#[must_use]
pub fn no_turns(span: Span, device: &str, group: &str, count: usize, all_ms: u32) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("{device} gets no turn in group {group}: its {count} devices take {all_ms} ms together"))
        .help(format!("write `delay = {all_ms} ms;` or more for all {count}, or `group = none;`"))
}
