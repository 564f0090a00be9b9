//! E0244: a serial part is asked, and speaks by itself.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0244",
    title: "a serial part is asked for one value, and sends another by itself",
    explanation: r#"Either the board listens to a serial part all the time, or it asks for each value and waits for the answer. A reading
with a `request` is asked for, and so is whatever shares its line. A message that comes by itself in between would be
taken for an answer, or tear one apart.

Way out: give each reading of the part a `request`, or none of them, and no `address`, `answer`, `resend` or `duplex` to
a part that speaks by itself."#,
});

/// A value that comes by itself, from a part that the board speaks with.
pub fn asked_and_listened(span: Span, name: &str, why: &str, why_span: Span) -> Diagnostic {
    let message = format!("{name} has no `request`, and the board speaks with its part");
    Diagnostic::new(CODE, span, message)
        .here("comes by itself")
        .label(why_span, why)
        .help("give it a `request`, or take `request`, `address`, `answer`, `resend` and `duplex` away from the part")
}
