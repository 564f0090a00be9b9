//! E0309: a row lists a usage twice.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0309",
    title: "a row lists a usage twice",
    explanation: r#"A usage that is listed twice would count twice in the pin's opportunity cost.

Way out: remove one of the two."#,
});

/// `first` is the earlier place of the usage.
pub fn table_usage_twice(span: Span, row: usize, usage: &str, first: Span) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("row {row} lists `{usage}` twice"))
        .here("again here")
        .label(first, "first here")
        .help("remove one of the two")
}
