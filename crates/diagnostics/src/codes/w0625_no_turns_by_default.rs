//! W0625: rangers of one board measure at the same time.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "W0625",
    title: "rangers of one board measure at the same time",
    explanation: r#"The rangers of the library are in group `ultrasonic`, because they hear each other. At these cycle times they cannot take
turns, so they measure at the same time, and one may report the echo of another.

Way out: give all of them the cycle time that the message names. Where they face away from each other, write `group = none;` or `allow W0625 "reason";`."#,
});

/// `device` gets no turn; `all_ms` is how long all of them take one after the other.
pub fn no_turns(span: Span, device: &str, group: &str, count: usize, all_ms: u32) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("{device} measures at the same time as others of group {group}: its {count} devices take {all_ms} ms together"))
        .help(format!("write `delay = {all_ms} ms;` or more for all {count}, and they take turns; or `group = none;`"))
}
