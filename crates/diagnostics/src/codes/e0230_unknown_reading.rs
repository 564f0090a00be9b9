//! E0230: a part has no such reading, command or connection.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0230",
    title: "a part has no such value",
    explanation: r#"A device of a chip is one of the readings (sensors) or commands (actuators) of the chip's driver: the one that
`reading = NAME;` names, otherwise the one of the device's own name, otherwise the only one there is.

Way out: take one of the names that the message lists; `sensedsl drivers NAME` shows all with their types."#,
});

/// `message` says what the part lacks, `has` what it has; `meant` is the nearest name.
pub fn unknown_reading(span: Span, message: &str, has: &str, meant: Option<&str>) -> Diagnostic {
    let diagnostic = Diagnostic::new(CODE, span, message);
    let has = if has.is_empty() { "it has none".to_owned() } else { format!("it has {has}") };
    match meant {
        Some(meant) => diagnostic.help(format!("did you mean `{meant}`? {has}")).one_of([meant]),
        None => diagnostic.help(format!("{has}: write `reading = NAME;`")),
    }
}
