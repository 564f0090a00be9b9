//! E0520: there is no firmware here.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0520",
    title: "there is no firmware here",
    explanation: r#"`build` and `flash` take a `.sense` file, of which they generate the firmware first, or a folder that
`sensedsl generate` wrote: the one that was named by `-o`, or that of one board in its `firmware/`. Without a
name they take the folder in which they are called, or the only `.sense` file in it. A folder that was written
with `--without firmware` has none.

Way out: name a file, or a folder with firmware."#,
});

/// `why` says what is wrong with `path`, worded to follow a colon.
pub fn no_firmware_here(span: Span, path: &str, why: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("there is no firmware to build in `{path}`: {why}"))
        .help("name a `.sense` file, or a folder that `sensedsl generate` wrote")
}
