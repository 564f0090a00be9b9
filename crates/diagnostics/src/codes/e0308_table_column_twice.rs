//! E0308: the head names a column twice.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0308",
    title: "the head names a column twice",
    explanation: r#"With two columns of the same name, there is no telling which one is meant.

Way out: rename or merge one of them."#,
});

/// `first` is the earlier place of the column's name.
pub fn table_column_twice(span: Span, column: &str, first: Span) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("there are two columns `{column}`"))
        .here("again here")
        .label(first, "first here")
        .help("rename or merge one of the two")
}
