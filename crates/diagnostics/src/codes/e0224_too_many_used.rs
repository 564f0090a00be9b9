//! E0224: files use too many others.

use crate::codes::{Code, CodeInfo};
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;

/// The registry entry.
pub const INFO: CodeInfo = CodeInfo {
    code: "E0224",
    severity: Severity::Error,
    title: "files use too many others",
    explanation: r#"A design may use up to 1,000 files, directly or through others, and up to 64 that use each other in a chain.

Way out: put what belongs together into one file.
"#,
};

/// The code.
pub const CODE: Code = Code(&INFO);

/// A chain of more than `most` files.
#[must_use]
pub fn chain_too_long(span: Span, most: usize) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("more than {most} files use each other in a chain"))
        .help("use the files from one file instead of each from the one before")
}

/// More than `most` files in all.
#[must_use]
pub fn too_many_used(span: Span, most: usize) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("the design uses more than {most} files"))
        .help("put what belongs together into one file")
}
