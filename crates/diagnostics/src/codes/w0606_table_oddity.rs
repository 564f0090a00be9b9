//! W0606: something in the board table looks odd.

use crate::codes::{Code, CodeInfo};
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;

/// The registry entry.
pub const INFO: CodeInfo = CodeInfo {
    code: "W0606",
    severity: Severity::Warning,
    title: "something in the board table looks odd",
    explanation: r#"The table could be read, but a cell is not what such a cell usually is.

Way out: correct the cell, or leave it where it is meant.
"#,
};

/// The code.
pub const CODE: Code = Code(&INFO);

/// `row` is the row; `column` is the column if a single cell is meant.
#[must_use]
pub fn table_oddity(span: Span, row: usize, column: Option<&str>, what: &str) -> Diagnostic {
    let place = column.map_or(String::new(), |column| format!(", column {column}"));
    Diagnostic::new(CODE, span, format!("row {row}{place}: {what}"))
        .help("correct the cell, or leave it where it is meant")
}
