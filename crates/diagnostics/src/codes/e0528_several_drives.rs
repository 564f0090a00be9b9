//! E0528: there are several drives that the program could be copied to.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0528",
    title: "there are several drives that the program could be copied to",
    explanation: r#"Several boards with the right chip are plugged in, and each shows its drive. Nothing tells which of them is meant, so
none was written to.

Way out: unplug the others, or name the drive with `--drive DIR`."#,
});

/// `folders` are those at which the drives are mounted.
pub fn several(span: Span, board: &str, folders: &[String]) -> Diagnostic {
    let message = format!("{} drives could be that of {board}", folders.len());
    Diagnostic::new(CODE, span, message)
        .help(format!("unplug the others, or say which with `--drive DIR`: {}", folders.join(", ")))
}
