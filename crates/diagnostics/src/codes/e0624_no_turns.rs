//! E0624: the devices of a group cannot take turns.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0624",
    title: "the devices of a group cannot take turns",
    explanation: r#"Devices of one group never measure at the same time. Each keeps its cycle time, so their measurements must fit into it one
after the other; with different cycle times, into the greatest time that divides both.

Way out: give all of them the cycle time that the message names, or leave a device out of the group (`group = none;`)."#,
});

/// `device` gets no turn; `all_ms` is how long all of them take one after the other.
pub fn no_turns(span: Span, device: &str, group: &str, count: usize, all_ms: u32) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("{device} gets no turn in group {group}: its {count} devices take {all_ms} ms together"))
        .help(format!("write `delay = {all_ms} ms;` or more for all {count}, or `group = none;`"))
}
