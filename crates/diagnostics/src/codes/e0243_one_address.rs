//! E0243: two parts on one serial line have one address.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0243",
    title: "two parts on one serial line have one address",
    explanation: r#"Parts with an `address` share the wires of one serial port, and each answers to its own number. Two with the same one
answer at the same time, and nobody understands either of them. New servos all have the number that they were made
with; the maker's tool, or the part's manual, says how to give one another number: connect it alone for that.

Way out: give one of them another `address`. Where they are meant to be on different wires, name the `unit` of both."#,
});

/// Two parts with the same address, which would share a line.
pub fn one_address(span: Span, name: &str, address: u8, other: &str, other_span: Span) -> Diagnostic {
    let message = format!("{name} and {other} have address {address} on one line");
    Diagnostic::new(CODE, span, message)
        .here("the same address")
        .label(other_span, "first used here")
        .help("give one of them another `address`, or name a `unit` for each, so that they are on different wires")
}
