//! W0805: something of the source may mean something else.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "W0805",
    title: "something of the source may mean something else",
    explanation: r#"A cell was read, but it may not mean what it seems to: the value of a formula as it was last computed, a
merged cell, a number where a name is usual, bytes that are not UTF-8.

Way out: compare the place with the result."#,
});

/// `place` is the place as its program shows it (`Sheet1!C3`; may be empty), `what` says how it was read.
pub fn import_doubtful(span: Span, place: &str, what: &str) -> Diagnostic {
    let place = if place.is_empty() { String::new() } else { format!("{place}: ") };
    Diagnostic::new(CODE, span, format!("{place}{what}")).help("compare the place with the result")
}
