//! E0245: an encoding that sends values of another type.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0245",
    title: "the encoding sends values of another type",
    explanation: r#"An LED strip takes a colour for each LED: a number 0xRRGGBB, so that its value is an array of `uint32` with an element
for each LED. A line of text takes a letter for each element: its value is an array of `uint8`.

Way out: give the actuator the type that the message names, with as many elements as there are LEDs or letters."#,
});

/// `name` is the encoding, which stands at `source` where that is elsewhere; `what` are the things that it sends,
/// `scalar` is the type of one, and `found` the type as written.
pub fn other_encoding(
    span: Span,
    source: Option<Span>,
    (name, what, scalar): (&str, &str, &str),
    found: &str,
) -> Diagnostic {
    let message =
        format!("`encoding = {name}` sends {what}, a {scalar} each, and the value is {found}");
    Diagnostic::new(CODE, span, message)
        .here(format!("must be {scalar}, or an array of them"))
        .label(source, format!("sends {what}"))
        .help(format!("write `accepts {scalar}[8]` for eight {what}"))
}
