//! E0254: a time of a test that cannot be.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0254",
    title: "a time of a test that cannot be",
    explanation: r#"Times of a test count from its beginning, have a unit (`us`, `ms`, `s`), and lie within its length, `for`. `from` is
before `to`. `within` is how long something may take: it follows `eventually … within` and `when … then … within`;
`always` and `never` have none, because they hold all the time.

Way out: write a time that is within `for`, or make the test longer."#,
});

/// It is not a time.
pub fn not_a_time(span: Span, found: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("a time is needed here, not {found}"))
        .help("write a number with a unit: `500 ms`")
}

/// It is after the end of the test.
pub fn after_end(span: Span, time: &str, end: &str, at: Span) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("the test is over after {end}, before {time}"))
        .label(at, "its length")
        .help("write an earlier time, or make `for` longer")
}

/// It ends before it begins.
pub fn reversed(span: Span, from: &str, to: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("this ends at {to}, and begins at {from}"))
        .help("write the earlier time after `from`")
}

/// A clause that such a rule does not have, or that it has twice.
pub fn misplaced(span: Span, word: &str, help: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{word}` cannot stand in this rule")).help(help)
}
