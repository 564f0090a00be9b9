//! E0309: a row lists a usage twice.

use crate::codes::{Code, CodeInfo};
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;

/// The registry entry.
pub const INFO: CodeInfo = CodeInfo {
    code: "E0309",
    severity: Severity::Error,
    title: "a row lists a usage twice",
    explanation: r#"A usage that is listed twice would count twice in the pin's opportunity cost.

Way out: remove one of the two.
"#,
};

/// The code.
pub const CODE: Code = Code(&INFO);

/// `first` is the earlier place of the usage.
#[must_use]
pub fn table_usage_twice(span: Span, row: usize, usage: &str, first: Span) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("row {row} lists `{usage}` twice"))
        .here("again here")
        .label(first, "first here")
        .help("remove one of the two")
}
