//! E0622: the link cannot carry the reports.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0622",
    title: "the link cannot carry the reports",
    explanation: r#"The values that are read each cycle come to more bytes in a second than the link carries. Values would get older with each
report, and most would never be sent. What measures by itself (a counter, an encoder) is not counted here: it is sent as often as there is room.

Way out: longer cycle times, a faster link, or a `rate`: then at most so many reports go out in a second, each with the latest values."#,
});

/// `message` says what is asked for and what can be carried, `help` what to do.
pub fn link_too_slow(span: Span, message: &str, help: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, message).here("most of it comes from here").help(help)
}
