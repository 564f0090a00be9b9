//! E0801: the source cannot be imported.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0801",
    title: "the source cannot be imported",
    explanation: r#"The file is none of the formats that `import` reads, is damaged, or a file that belongs to it is missing:
the description of an MCU in XML needs the file `IP/GPIO-…_Modes.xml` that it names, beside it.

Way out: give the file itself (not an archive of it), keep the folders of its installation together, or say
what it is with `--format`."#,
});

/// `what` could not be read; `why` is the reason.
pub fn import_unreadable(span: Span, what: &str, why: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("cannot import {what}: {why}")).help(
        "`sensedsl explain E0801` lists what an import needs; `--format` says what the file is",
    )
}
