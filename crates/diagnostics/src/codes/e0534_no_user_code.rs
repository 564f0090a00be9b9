//! E0534: there is no code for a controller.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0534",
    title: "there is no code for a controller",
    explanation: r#"A controller's step is a function of yours: `follow_step` in `user/follow.c` of the board's firmware, or `step` in
`src/user/follow.rs` where the firmware is in Rust. `sensedsl generate` makes the file once, and never changes it again.

Way out: `sensedsl generate FILE -o out` makes the files that are missing. `--code FOLDER` names the board's firmware if
it is somewhere else."#,
});

/// `file` is what was looked for.
pub fn no_user_code(span: Span, controller: &str, file: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("there is no code for `{controller}`: {file} does not exist"))
        .help("`sensedsl generate FILE -o out` makes the file; `--code FOLDER` names the firmware's folder if it is elsewhere")
}
