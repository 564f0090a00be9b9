//! E0809: an included file may not be read.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0809",
    title: "an included file may not be read",
    explanation: r#"What a source names must be a regular file in the folder of the source or below it; for an `hwdef.dat` also
in a folder beside that, where ArduPilot keeps the boards that boards include.

Way out: copy the file there, or allow its folder on the command line: `--allow-outside FOLDER`."#,
});

/// `path` is the path as the source names it, `why` the reason, `help` the way out.
pub fn include_unreadable(span: Span, path: &str, why: &str, help: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{path}` is not read: {why}")).help(help.to_owned())
}
