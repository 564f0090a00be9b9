//! E0251: two controllers set one device.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0251",
    title: "two controllers set one device",
    explanation: r#"Each device has at most one controller that sets it. Of two, the later step would undo what the earlier one did, and
which of them wins would change from cycle to cycle.

Way out: let one controller set the device, and give it what the other one computes as a sensor of `type = code`, which
it reads."#,
});

/// `first` is the controller that sets it already.
pub fn two_owners(span: Span, name: &str, first: &str, at: Span) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{name}` is set by the controller `{first}` already"))
        .label(at, "set here first")
        .help(format!(
            "let one of them set `{name}`; the other one may set a sensor of `type = code` that this one reads"
        ))
}
