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

/// `name` is the encoding, `found` the type as written, `what` the things that it sends, `scalar` the type of one.
pub fn other_encoding(span: Span, name: &str, found: &str, what: &str, scalar: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`encoding = {name}` sends {what}, and the value is {found}"))
        .here(format!("sends {what}, a {scalar} each"))
        .help(format!("write `accepts {scalar}[8]` for eight {what}"))
}
