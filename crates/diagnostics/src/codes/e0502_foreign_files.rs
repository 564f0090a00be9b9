//! E0502: the output folder holds other files.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0502",
    title: "the output folder holds other files",
    explanation: r#"`generate` owns the folder it writes to: it keeps a list of its files, rewrites them and removes those
it no longer makes. A folder with files that are not on the list is not touched, so that nothing of
yours is lost. Your own code belongs in the folders named `user`.

Way out: choose another folder, or move the files that the message names."#,
});

/// `files` lists some of the foreign files.
pub fn foreign_files(span: Span, folder: &str, files: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{folder}` holds files that are not generated: {files}"))
        .help("choose another folder, or move them; your own code belongs in `user/`")
}
