//! E0508: the file to write exists.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0508",
    title: "the file to write exists",
    explanation: r#"`import -o`, `new` and `solve --proof` do not replace what is there, so that nothing of yours is lost.
A file that is empty, or that already holds what would be written, may be replaced, and `--proof`
replaces an earlier certificate. `import -o NAME.sense` of a project also writes `NAME.csv` beside it.
When one of several files is in the way, none is written. `new` wants an empty folder.

Way out: choose another name, or give `--force` to replace the file."#,
});

/// `file` is in the way of `what`.
pub fn file_exists(span: Span, file: &str, what: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{file}` exists and is not replaced by {what}"))
        .help("nothing was written; choose another name, or give `--force` to replace it")
}

/// `folder` is not empty: it has `file` in it.
pub fn folder_not_empty(span: Span, folder: &str, file: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{folder}` is not empty: it holds `{file}`")).help(
        "nothing was written; name a folder that does not exist yet, or give `--force` to write into it",
    )
}
