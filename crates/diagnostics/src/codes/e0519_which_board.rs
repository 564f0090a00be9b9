//! E0519: it is not clear which board is meant.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0519",
    title: "it is not clear which board is meant",
    explanation: r#"A file may have several boards, and each has a firmware of its own. `build` builds all of them unless `--board`
names one; `flash` writes one, so where there are several it must be told which; `simulate` runs the first one unless
`--board` names another. The name is the one in the file,
which is also that of the folder in `firmware/`.

Way out: give `--board NAME` with one of the names that the message lists."#,
});

/// There are several boards; `boards` has their names.
pub fn several(span: Span, boards: &[&str]) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("there are {} boards, and `flash` writes one", boards.len()))
        .help(format!("say which with `--board NAME`: {}", boards.join(", ")))
}

/// No board has this name; `boards` has the names of all.
pub fn unknown(span: Span, name: &str, boards: &[&str]) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("there is no firmware of a board `{name}`"))
        .help(format!("there is one of {}", boards.join(", ")))
}

/// No board called `name` carries a device of the file. `boards` are the ones that do.
pub fn not_in_file(span: Span, name: &str, boards: &[&str]) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("no board `{name}` carries a device of this file"))
        .help(format!("say which with `--board NAME`: {}", boards.join(", ")))
}
