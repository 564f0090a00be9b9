//! E0509: the output folder could not be written.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0509",
    title: "the output folder could not be written",
    explanation: r#"`generate` writes all or nothing. The disk is full, or something may not be written there, so the
folder is as it was before; what was written beside it is removed again.
In rare cases the disk fails when the new files are in their places and only the work behind them is
left. The message says so, and the next run completes it.

Way out: make room on the disk or allow writing, as the message says, and run `generate` again. It
needs room for the new files beside the old ones for a moment."#,
});

/// The folder is unchanged.
pub fn not_written(span: Span, folder: &str, why: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{folder}` could not be written: {why}"))
        .help("it is as it was before; fix what the message says and run `generate` again")
}

/// The new files are there, or will be when the next run has completed the rest.
pub fn not_completed(span: Span, folder: &str, why: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("writing `{folder}` could not be completed: {why}"))
        .help("fix what the message says; the next `generate` completes what is left")
}
