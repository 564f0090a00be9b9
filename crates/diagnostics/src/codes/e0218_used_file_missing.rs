//! E0218: a used file cannot be read.

use crate::codes::{Code, CodeInfo};
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;

/// The registry entry.
pub const INFO: CodeInfo = CodeInfo {
    code: "E0218",
    severity: Severity::Error,
    title: "a used file cannot be read",
    explanation: r#"The path after `use` is relative to the file that holds it.

Way out: correct the path.
"#,
};

/// The code.
pub const CODE: Code = Code(&INFO);

/// `path` is the resolved path, `why` the operating system's reason.
#[must_use]
pub fn used_file_missing(span: Span, path: &str, why: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("cannot read `{path}`: {why}"))
        .help("the path is relative to the file that holds this line")
}
