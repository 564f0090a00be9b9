//! E0308: a column stands twice in the head.

use crate::codes::{Code, CodeInfo};
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;

/// The registry entry.
pub const INFO: CodeInfo = CodeInfo {
    code: "E0308",
    severity: Severity::Error,
    title: "a column stands twice in the head",
    explanation: r#"Two columns of one name: which is meant cannot be told.

Way out: rename or merge one of them.
"#,
};

/// The code.
pub const CODE: Code = Code(&INFO);

/// The column's name and its earlier place.
#[must_use]
pub fn table_column_twice(span: Span, column: &str, first: Span) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("the column `{column}` stands twice"))
        .here("again here")
        .label(first, "first here")
        .help("rename or merge one of the two")
}
