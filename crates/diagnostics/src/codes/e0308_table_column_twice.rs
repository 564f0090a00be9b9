//! E0308: the head names a column twice.

use crate::codes::{Code, CodeInfo};
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;

/// The registry entry.
pub const INFO: CodeInfo = CodeInfo {
    code: "E0308",
    severity: Severity::Error,
    title: "the head names a column twice",
    explanation: r#"With two columns of the same name, there is no telling which one is meant.

Way out: rename or merge one of them.
"#,
};

/// The code.
pub const CODE: Code = Code(&INFO);

/// `first` is the earlier place of the column's name.
#[must_use]
pub fn table_column_twice(span: Span, column: &str, first: Span) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("there are two columns `{column}`"))
        .here("again here")
        .label(first, "first here")
        .help("rename or merge one of the two")
}
