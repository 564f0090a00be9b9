//! E0515: the tree lacks a file that the board needs.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0515",
    title: "the tree lacks a file that the board needs",
    explanation: r#"Firmware is built from files of the ChibiOS tree: start-up code, drivers, the folder of the board, and the
configuration of a demo that the board's own builds on. One of them is missing, so the tree was fetched in
part (a sparse clone, `os` without `demos`), or something was removed from it.

Way out: fetch the tree again, whole:

    git clone --depth 1 -b stable_21.11.x https://github.com/ChibiOS/ChibiOS.git"#,
});

/// `missing` lists the files that the board needs and the tree in `folder` lacks.
pub fn tree_incomplete(span: Span, folder: &str, board: &str, missing: &[String]) -> Diagnostic {
    let all = missing.join("`, `");
    Diagnostic::new(CODE, span, format!("the ChibiOS tree `{folder}` lacks what {board} needs: `{all}`"))
        .help("the tree is not whole: fetch it again, with `demos` and all of `os`")
}
