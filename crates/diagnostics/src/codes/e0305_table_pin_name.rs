//! E0305: not a pin name.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0305",
    title: "not a pin name",
    explanation: r#"The column `Pin` holds the pin's name as the data sheet spells it: PA1, PB10, GP4, D13.

Way out: correct the cell."#,
});

/// `row` is the number of the row, `found` the cell's text.
pub fn table_pin_name(span: Span, row: usize, found: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("row {row}, column Pin: `{found}` is not a pin name"))
        .help("write the name of the data sheet, such as PA1 or GP4")
}
