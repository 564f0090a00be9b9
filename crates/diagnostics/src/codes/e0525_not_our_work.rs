//! E0525: an unfinished run is not of this machine.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0525",
    title: "an unfinished run is not of this machine",
    explanation: r#"A run of `generate` that is cut off leaves its work in `DIR/.sensedsl-work`, or in
`.NAME.sensedsl-work` and `.NAME.sensedsl-unfinished` beside the output folder `NAME`. The next run
completes it, which writes and removes files. So it believes only what a run of the same user on the
same machine has left, and tells that by a code that nobody else can make. What stands here has no
such code: it came with a download or a copy, is of an earlier version, or the user's folder for
state (`~/.local/state/sensedsl`) is gone.

Way out: look into what the message names. Move what is yours to where you want it, remove the rest,
and run `generate` again."#,
});

/// `left` is what looks like an unfinished run.
pub fn not_our_work(span: Span, folder: &str, left: &str) -> Diagnostic {
    let message = format!("`{left}` looks like an unfinished run for `{folder}`, and not one of this machine");
    Diagnostic::new(CODE, span, message)
        .help("move what is yours out of it, remove it, and run `generate` again")
}
