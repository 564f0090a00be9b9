//! E0304: a pin has two rows.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0304",
    title: "a pin has two rows",
    explanation: r#"Each pin has one row; several usages of one kind go into one cell, separated by spaces.

Way out: merge the rows."#,
});

/// `first` is the earlier row.
pub fn table_pin_twice(span: Span, pin: &str, row: usize, first: Span, first_row: usize) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("row {row}: the pin {pin} has a row already"))
        .here("again here")
        .label(first, format!("first in row {first_row}"))
        .help("merge the two rows: usages in one cell are separated by spaces")
}
