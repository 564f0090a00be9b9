//! E0507: another run writes the output folder.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0507",
    title: "another run writes the output folder",
    explanation: r#"One run of `generate` at a time writes a folder. A second one waits for the first, for half a minute,
which is far longer than writing takes; then it gives up and changes nothing.

Way out: look for a `sensedsl generate` that hangs or is stopped, end it, and run the command again.
The lock ends with the process that holds it; there is no file to remove."#,
});

/// `waited_s` is how long the run has waited for `folder`.
pub fn folder_busy(span: Span, folder: &str, waited_s: u64) -> Diagnostic {
    let message = format!("another `sensedsl generate` has been writing `{folder}` for {waited_s} s");
    Diagnostic::new(CODE, span, message)
        .help("nothing was written; end the other run if it hangs, then run `generate` again")
}
