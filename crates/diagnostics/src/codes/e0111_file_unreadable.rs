//! E0111: a file cannot be read.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0111",
    title: "a file cannot be read",
    explanation: r#"The file that the command line names cannot be opened or read, or is not text in UTF-8.

Way out: correct the path, look at the permissions of the file and its folders, or save it as UTF-8."#,
});

/// `why` is the reason, in words.
pub fn file_unreadable(span: Span, path: &str, why: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("cannot read {path}: {why}"))
        .help("correct the path, or make the file a readable text in UTF-8")
}
