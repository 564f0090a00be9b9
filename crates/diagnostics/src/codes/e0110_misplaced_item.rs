//! E0110: this does not belong here.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0110",
    title: "this does not belong here",
    explanation: r#"Boards, drivers, constants and `use` belong at the top of a file; rules (`reserve`, `release`) and
`link` belong in a board; `prefer`, `avoid` and `allow` in a board, a chip or a device; `reading` and
`command` in a driver.

Way out: move it where it belongs."#,
});

/// `what` is the item, `belongs` the place where it belongs.
pub fn misplaced_item(span: Span, what: &str, belongs: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("{what} does not belong here"))
        .help(format!("move it: it belongs {belongs}"))
}
