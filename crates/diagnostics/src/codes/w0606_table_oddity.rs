//! W0606: something in the board table looks odd.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "W0606",
    title: "something in the board table looks odd",
    explanation: r#"The table could be read, but a cell is not what such a cell usually is.

Way out: correct the cell, or leave it where it is meant."#,
});

/// `row` is the row; `column` is the column if a single cell is meant.
pub fn table_oddity(span: Span, row: usize, column: Option<&str>, what: &str) -> Diagnostic {
    let place = column.map_or(String::new(), |column| format!(", column {column}"));
    Diagnostic::new(CODE, span, format!("row {row}{place}: {what}"))
        .help("correct the cell, or leave it where it is meant")
}
