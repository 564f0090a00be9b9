//! E0304: a pin has two rows.

use crate::codes::{Code, CodeInfo};
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;

/// The registry entry.
pub const INFO: CodeInfo = CodeInfo {
    code: "E0304",
    severity: Severity::Error,
    title: "a pin has two rows",
    explanation: r#"Each pin has one row; several usages of one kind go into one cell, separated by spaces.

Way out: merge the rows.
"#,
};

/// The code.
pub const CODE: Code = Code(&INFO);

/// `first` is the earlier row.
#[must_use]
pub fn table_pin_twice(span: Span, pin: &str, row: usize, first: Span, first_row: usize) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("row {row}: the pin {pin} has a row already"))
        .here("again here")
        .label(first, format!("first in row {first_row}"))
        .help("merge the two rows: usages in one cell are separated by spaces")
}
