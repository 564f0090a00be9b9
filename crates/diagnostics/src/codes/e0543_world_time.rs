//! E0543: a time in a world is impossible.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0543",
    title: "a time that cannot be",
    explanation: r#"Times are a number with a unit, `"1.5 s"`, `"20 ms"`, `"300 us"`, or a number of seconds, counted from the moment at which
the board gets power. Steps, the points of a CSV file and their times go forwards: each is later than the one before it.

Way out: write a time with a unit, and put points in the order of their times."#,
});

/// A point is not later than the one before it.
pub fn backwards(span: Span, time: &str, before: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("the time runs backwards: {time} comes after {before}"))
        .here("earlier than the one before")
        .help("put the points in the order of their times")
}

/// Not a time.
pub fn not_a_time(span: Span, found: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{found}` is not a time"))
        .help("write for example \"1.5 s\", \"20 ms\" or \"300 us\"")
}
