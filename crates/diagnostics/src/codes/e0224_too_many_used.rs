//! E0224: files use too many others.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0224",
    title: "files use too many others",
    explanation: r#"A design may use up to 1,000 files, directly or through others, and up to 64 that use each other in a chain.

Way out: put what belongs together into one file."#,
});

/// A chain of more than `most` files.
pub fn chain_too_long(span: Span, most: usize) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("more than {most} files use each other in a chain"))
        .help("use the files from one file instead of each from the one before")
}

/// More than `most` files in all.
pub fn too_many_used(span: Span, most: usize) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("the design uses more than {most} files"))
        .help("put what belongs together into one file")
}
