//! E0510: an earlier run was cut off, and what it belongs to was moved.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0510",
    title: "an unfinished folder holds files of yours",
    explanation: r#"A run of `generate` that is cut off in the middle of its switch leaves a folder `.NAME.sensedsl-unfinished`
beside the output folder `NAME`, which may hold your `user/` folders; the next run completes it by
itself. Here it cannot, because the output folder was moved or replaced in between, and `generate`
removes nothing of yours.

Way out: move your files from the folder that the message names to where you want them, remove that
folder, and run `generate` again."#,
});

/// `folder` is the output folder, `left` what the earlier run left.
pub fn unfinished(span: Span, folder: &str, left: &str) -> Diagnostic {
    let message = format!("`{left}` is left over from an earlier run and does not belong to `{folder}`");
    Diagnostic::new(CODE, span, message)
        .help("move your files out of it, remove it, and run `generate` again")
}
