//! E0514: the tree is another release of ChibiOS.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0514",
    title: "the tree is another release of ChibiOS",
    explanation: r#"Drivers and their settings differ from one release of ChibiOS to the next, and this firmware was written for one
of them. Patch releases of the same one (21.11.1, 21.11.5) all do. The release is read from
`os/license/chversion.h`, or from `os/rt/include/ch.h` where that is missing.

Way out: name a tree of the release that the message asks for, or switch the one you have:

    git -C $CHIBIOS switch stable_21.11.x"#,
});

/// `found` is the release of the tree in `folder`, `version` the required one.
pub fn other_tree(span: Span, folder: &str, found: &str, version: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{folder}` is ChibiOS {found}, this firmware needs {version}"))
        .help(format!(
            "name a tree of {version}; in a clone: `git -C {folder} fetch origin stable_{version}.x && \
             git -C {folder} switch stable_{version}.x`"
        ))
}
