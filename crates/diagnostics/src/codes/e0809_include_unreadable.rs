//! E0809: an included file may not be read.

use crate::codes::{Code, CodeInfo};
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;

/// The registry entry.
pub const INFO: CodeInfo = CodeInfo {
    code: "E0809",
    severity: Severity::Error,
    title: "an included file may not be read",
    explanation: r#"What a source names must be a regular file in the folder of the source or below it; for an `hwdef.dat` also
in a folder beside that, where ArduPilot keeps the boards that boards include.

Way out: copy the file there, or allow its folder on the command line: `--allow-outside FOLDER`.
"#,
};

/// The code.
pub const CODE: Code = Code(&INFO);

/// `path` is the path as the source names it, `why` the reason, `help` the way out.
#[must_use]
pub fn include_unreadable(span: Span, path: &str, why: &str, help: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{path}` is not read: {why}")).help(help.to_owned())
}
