//! E0802: there is no pin table in the source.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0802",
    title: "there is no pin table in the source",
    explanation: r#"A table is found by its head: a row with a cell such as `Pin`, `Pin name` or `GPIO`, or with the columns
`AF0` to `AF15`. Below it stand rows that name pins. Boards and projects of other tools say what their pins are for; a
board of Betaflight that is only simulated, for example, does not.

Way out: call the column of the pins `Pin`; in a workbook, name the sheet with `--sheet`. Of another tool's files name
the one with the pins; `--format` says what a file is when its content is taken for something else."#,
});

/// Of a table: `what` says what was looked for, and where.
pub fn import_no_table(span: Span, what: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("no pin table: {what}"))
        .help("call the column of the pins `Pin`")
}

/// Of another tool's board or project: `what` says what was looked for.
pub fn import_no_pins(span: Span, what: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("no pins: {what}"))
        .help("import the file in which pins are given a use, or say with `--format` what this one is")
}
