//! E0242: two parts on 1-Wire have one address.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0242",
    title: "two 1-Wire parts have one address",
    explanation: r#"The address of a 1-Wire part (`rom`) is burnt in when it is made, and no two parts in the world have the same. Two
parts of a design with one address are a slip of the pen: both would show the value of one sensor.

Way out: write the address of each part. Several values of one part belong in one `chip`."#,
});

/// `name` and `other` are the parts, each with the place of its address.
pub fn same_rom((span, name): (Span, &str), (other_span, other): (Span, &str), rom: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("{name} and {other} have the address {rom}"))
        .here("here")
        .label(other_span, "and here")
        .help("write the address of each part: no two have the same")
}
