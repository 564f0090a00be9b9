//! E0317: a board table is too large.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0317",
    title: "a board table is too large",
    explanation: r#"A table describes the pins of one board or MCU: a few hundred rows with a few dozen columns. What is far
beyond is not read; `docs/limits.md` has the limits for cells, pins and usages of one pin.

Way out: name the right file, and remove rows, columns and cells that do not describe pins."#,
});

/// `what` is what there is too much of, `most` the greatest number allowed.
pub fn table_too_large(span: Span, what: &str, most: usize) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("the table has more than {most} {what}"))
        .here("not read from here on")
        .help("remove what does not describe pins, or name the file that is meant")
}
