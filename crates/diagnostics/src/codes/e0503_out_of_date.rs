//! E0503: generated files are out of date.

use crate::codes::{Code, CodeInfo};
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;

/// The registry entry.
pub const INFO: CodeInfo = CodeInfo {
    code: "E0503",
    severity: Severity::Error,
    title: "generated files are out of date",
    explanation: r#"`generate --check` compares the folder with what would be written now.

Way out: run `generate` without `--check`.
"#,
};

/// The code.
pub const CODE: Code = Code(&INFO);

/// `files` says what differs ("missing", "differs", "no longer made"), with the paths.
#[must_use]
pub fn out_of_date(span: Span, folder: &str, files: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{folder}` is out of date: {files}"))
        .help("run `generate` again without `--check`")
}
