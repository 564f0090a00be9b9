//! E0218: a used file cannot be read.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0218",
    title: "a used file cannot be read",
    explanation: r#"The path after `use` is relative to the file that holds it.

Way out: correct the path."#,
});

/// `path` is the resolved path, `why` the operating system's reason.
pub fn used_file_missing(span: Span, path: &str, why: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("cannot read `{path}`: {why}"))
        .help("the path is relative to the file that holds this line")
}
