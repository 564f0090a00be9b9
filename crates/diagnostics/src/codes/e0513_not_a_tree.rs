//! E0513: what was named is not a ChibiOS tree.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0513",
    title: "this is not a ChibiOS tree",
    explanation: r#"`--chibios` or `CHIBIOS` names a folder that does not exist, that does not hold the sources of ChibiOS, or whose
path has a space or another sign in it that make cannot read. The folder is the one with `os`, `demos` and
`readme.txt` in it.

Way out: name that folder, or fetch a tree:

    git clone --depth 1 -b stable_21.11.x https://github.com/ChibiOS/ChibiOS.git"#,
});

/// `why` says what the folder lacks, worded to follow a colon.
pub fn not_a_tree(span: Span, folder: &str, why: &str, version: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{folder}` is not a ChibiOS tree: {why}")).help(format!(
        "name the folder that holds `os` and `demos`; to fetch one: \
         `git clone --depth 1 -b stable_{version}.x https://github.com/ChibiOS/ChibiOS.git`"
    ))
}

/// `sign` is a character in the folder's path that make interprets.
pub fn not_readable(span: Span, folder: &str, sign: char) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("make cannot read the path `{folder}`: it has `{sign}` in it"))
        .help("move the tree to a path of letters, digits, `-`, `_` and `.`, or name a link to it there")
}
