//! E0538: a rule of a test did not hold.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0538",
    title: "a rule of a test did not hold",
    explanation: r#"The board ran, and at some moment a rule of the test did not hold. The message has the first such moment with the
values as the host had them, and by how much the rule was missed. A rule that is about values that never came fails as
well: nobody knows whether it holds.

Way out: look at the code of the controller or at the world first, then at the rule. `--picture FILE.svg` draws the
signals around that moment."#,
});

/// `what` says when it was violated and by how much, `help` what the values were.
pub fn violated(span: Span, what: &str, help: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, what).here("this rule").help(help)
}

/// Nothing was known of what it is about.
pub fn unknown(span: Span, name: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("nobody knows whether this holds: no value of `{name}` came"))
        .here("this rule")
        .help("see whether the device answers: `sensedsl simulate FILE --health --seconds 2 --stdout`")
}

/// Its values came after the time that it is about.
pub fn too_late(span: Span) -> Diagnostic {
    Diagnostic::new(CODE, span, "nobody knows whether this holds: its values came after its time")
        .here("this rule")
        .help("let it begin later, such as `from 2 s`: a board reports once its link is there")
}

/// The run ended before it was clear.
pub fn too_short(span: Span) -> Diagnostic {
    Diagnostic::new(CODE, span, "the test ended before it was clear whether this holds")
        .here("this rule")
        .help("make `for` longer")
}
