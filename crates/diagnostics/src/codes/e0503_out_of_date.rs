//! E0503: generated files are out of date.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0503",
    title: "generated files are out of date",
    explanation: r#"`generate --check` compares the folder with what would be written now.

Way out: run `generate` without `--check`."#,
});

/// `files` says what differs ("missing", "differs", "no longer made"), with the paths.
pub fn out_of_date(span: Span, folder: &str, files: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{folder}` is out of date: {files}"))
        .help("run `generate` again without `--check`")
}
