//! E0240: two commands of a chip take the same bits of a register.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0240",
    title: "two commands of a chip take the same bits of a register",
    explanation: r#"Commands of a chip that are written to the same register share it: each changes its own bits and leaves the others as
they are. Where two of them take the same bits, each would undo what the other one has done. The whole port of an
expander and one of its pins are such a pair.

Way out: take out one of the two. In a driver, give each command bits of its own (`bits = 3..3`)."#,
});

/// `name` and `other` are the commands; `register` is the register's number, if it has one.
pub fn overlap_in_register(
    span: Span,
    name: &str,
    other: &str,
    other_span: Span,
    register: Option<&str>,
) -> Diagnostic {
    let place = register.map_or("the same bits".to_owned(), |one| format!("the same bits of register {one}"));
    Diagnostic::new(CODE, span, format!("{name} and {other} take {place}"))
        .here("here")
        .label(other_span, "and here")
        .help("take out one of them, or use a driver that gives each command bits of its own (`bits = 3..3`)")
}
