//! E0807: a source is too large to be imported.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0807",
    title: "a source is too large to be imported",
    explanation: r#"A workbook is a compressed archive: a small file can hold gigabytes, and one cell can say that it is repeated
a million times. What is inside is counted while it is read, and reading stops at the limits of
`docs/limits.md`. They are far above what a table of pins needs. Other sources are counted in the same way: the lines of an
`hwdef.dat`, the messages and signals of a DBC file.

Way out: copy the pins to a new workbook, or export the sheet as CSV. Of another source, keep what concerns the
board: of a DBC file the messages that its node sends or receives."#,
});

/// `what` is what the source has too much of, `most` the greatest number allowed.
pub fn import_too_large(span: Span, name: &str, what: &str, most: usize) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("{name} has more than {most} {what}"))
        .help("keep what concerns the board: the sheet with the pins as CSV, the messages of its node")
}
