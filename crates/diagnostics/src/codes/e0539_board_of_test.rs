//! E0539: the board of a test cannot be run.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0539",
    title: "a test without its board",
    explanation: r#"`sensedsl test FILE --on WHERE` runs tests on an image of the firmware (a file, or `image` for the one that `build` made)
or on a real board (its port). The board must be there for the whole test, and have the schema of this file.

Way out: `sensedsl build FILE` makes the image, `sensedsl flash FILE` writes it to the board, and `sensedsl doctor` lists
the ports of this machine. Without `--on` the tests run in this program."#,
});

/// No image was built.
pub fn no_image(span: Span, board: &str, looked: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{board}` has not been built: there is no image in {looked}"))
        .help("make it with `sensedsl build FILE`, or name it: `--on PATH`")
}

/// The port was not opened; `why` is the reason, `cure` what helps.
pub fn not_opened(span: Span, port: &str, why: &str, cure: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("{port} cannot be opened: {why}")).help(cure)
}

/// One image or port, and several boards.
pub fn several(span: Span, test: &str, boards: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("the test `{test}` is about several boards: {boards}"))
        .help("run it without `--on`, or with `--on image`, which takes the image of each")
}

/// It stopped during the test.
pub fn stopped(span: Span, when: &str, why: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("the board stopped answering at {when}: {why}")).help(
        "see that it runs: `sensedsl monitor FILE`; a board with other firmware gets this file's with `sensedsl flash FILE`",
    )
}
