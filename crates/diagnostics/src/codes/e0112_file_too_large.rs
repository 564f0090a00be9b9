//! E0112: a file is too large.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0112",
    title: "a file is too large",
    explanation: r#"A real design has a few kilobytes, a real table a few hundred. A file that is far larger is not what it is
taken for, and reading it would take the memory of the machine. The same holds for all files of one call
together. The limits are listed in `docs/limits.md`.

Way out: name the right file, or split it with `use`."#,
});

/// `what` is what the limit is for, `bytes_max` the most bytes that are read.
pub fn file_too_large(span: Span, path: &str, what: &str, bytes_max: usize) -> Diagnostic {
    let most = bytes_max >> 20;
    Diagnostic::new(CODE, span, format!("{path} is too large: {what} has at most {most} MiB"))
        .help("name the file that is meant, or take out what does not belong to it")
}

/// `path` is the file with which the limit is exceeded, `bytes_max` the most bytes for all files.
pub fn all_too_large(span: Span, path: &str, bytes_max: usize) -> Diagnostic {
    let most = bytes_max >> 20;
    Diagnostic::new(
        CODE,
        span,
        format!("{path} is not read: all files of one call have at most {most} MiB"),
    )
    .help("use fewer or smaller files")
}
