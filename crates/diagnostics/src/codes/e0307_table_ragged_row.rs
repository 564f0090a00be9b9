//! E0307: a row has too many or too few cells.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0307",
    title: "a row has too many or too few cells",
    explanation: r#"Every row has a cell for each column of the head; an empty cell is empty or `-`.

Way out: add or remove separators."#,
});

/// `cells` is the number of cells of the row, `columns` that of the head.
pub fn table_ragged_row(span: Span, row: usize, cells: usize, columns: usize) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("row {row} has {cells} cells, the head has {columns} columns"))
        .help("give each column a cell; an empty one is `-`")
}
