//! E0507: another run writes the output folder.

use crate::codes::{Code, CodeInfo};
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;

/// The registry entry.
pub const INFO: CodeInfo = CodeInfo {
    code: "E0507",
    severity: Severity::Error,
    title: "another run writes the output folder",
    explanation: r#"One run of `generate` at a time writes a folder. A second one waits for the first, for half a minute,
which is far longer than writing takes; then it gives up and changes nothing.

Way out: look for a `sensedsl generate` that hangs or is stopped, end it, and run the command again.
The lock ends with the process that holds it; there is no file to remove.
"#,
};

/// The code.
pub const CODE: Code = Code(&INFO);

/// `waited_s` is how long the run has waited for `folder`.
#[must_use]
pub fn folder_busy(span: Span, folder: &str, waited_s: u64) -> Diagnostic {
    let message = format!("another `sensedsl generate` has been writing `{folder}` for {waited_s} s");
    Diagnostic::new(CODE, span, message)
        .help("nothing was written; end the other run if it hangs, then run `generate` again")
}
