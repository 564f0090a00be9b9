//! E0522: the board was not flashed.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0522",
    title: "the board was not flashed",
    explanation: r#"The firmware was built, and the tool that writes it to the board ended with an error, which stands above the
message. Common causes: another program (a debugger, another `flash`) holds the probe; the MCU sleeps or its debug
pins are used otherwise; the probe is that of another board. A drive that does not take the file may be mounted so that
it cannot be written, or belong to another user.

Way out: end the other program, hold the reset button while flashing begins, or try another tool with `--with`."#,
});

/// `how` says how `command` ended.
pub fn not_flashed(span: Span, board: &str, command: &str, how: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("{board} was not flashed: `{command}` ended with {how}"))
        .help("hold the reset button while flashing begins, or try another tool with `--with`")
}

/// `how` says why the drive at `folder` did not take the program.
pub fn not_copied(span: Span, board: &str, folder: &str, how: &str) -> Diagnostic {
    let message = format!("{board} was not flashed: its drive at {folder} did not take the program: {how}");
    Diagnostic::new(CODE, span, message)
        .help("unplug the board, start its boot loader again, and see that you may write to the drive")
}

/// The MCU is not known, but the tool needs it.
pub fn unknown_mcu(span: Span, board: &str, tool: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("{tool} wants to be told the MCU of {board}, which is not known here"))
        .help("name the whole folder that `generate` wrote, or the file; or flash with `--with st-flash`")
}
