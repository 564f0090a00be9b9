//! E0630: the step of a controller takes longer than its cycle.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0630",
    title: "the step of a controller takes longer than its cycle",
    explanation: r#"A controller's step begins once a cycle, and the next one can begin only after it has ended. `takes` says how long it
takes at most, so it must be less than the cycle after `every`.

Way out: a longer cycle, or a step that does less each time."#,
});

/// Both times are as people write them.
pub fn step_too_long(span: Span, name: &str, takes: &str, every: &str, at: Span) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("a step of `{name}` takes {takes}, and begins every {every}"))
        .label(at, "its cycle")
        .help("write a longer time after `every`, or a shorter one for `takes`")
}
