//! E0202: a property is given twice.

use crate::codes::{Code, CodeInfo};
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;

/// The registry entry.
pub const INFO: CodeInfo = CodeInfo {
    code: "E0202",
    severity: Severity::Error,
    title: "a property is given twice",
    explanation: r#"A property may be given once in a block. With two values there is no telling which one counts.

Way out: remove one of them.
"#,
};

/// The code.
pub const CODE: Code = Code(&INFO);

/// `first` is the earlier place of the name.
#[must_use]
pub fn property_twice(span: Span, name: &str, first: Span) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{name}` is given twice"))
        .here("again here")
        .label(first, "first here")
        .help("remove one of the two lines")
}
