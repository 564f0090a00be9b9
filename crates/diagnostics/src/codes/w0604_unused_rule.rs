//! W0604: a rule has no effect.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "W0604",
    title: "a rule has no effect",
    explanation: r#"The rule speaks of something that cannot happen here: an `allow` for a warning that is not given, a
`release` of a pin without an on-board part, a `prefer` that no pin can fulfil, an `avoid` of a pin, unit or place
that the board does not have.

Way out: correct the name, or remove the rule."#,
});

/// `why` is the reason why the rule has no effect.
pub fn unused_rule(span: Span, rule: &str, why: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{rule}` has no effect: {why}"))
        .help("remove the line")
        .remove("remove the line", span)
}
