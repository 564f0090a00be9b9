//! E0118: a pipe, a device or a folder is where a file is expected.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0118",
    title: "a pipe, a device or a folder is where a file is expected",
    explanation: r#"What a file names by `use`, as a table or as an include must be a regular file: reading a pipe or a device
may never end. A pipe can be read where the command line names it, and a program must be writing to it.

Way out: name a file; for the output of a program use `-` or `<(program)` on the command line."#,
});

/// `what` is what is there instead: `a pipe`.
pub fn not_a_file(span: Span, path: &str, what: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("{path} is {what}, not a file"))
        .help("name a file; `-` on the command line reads the standard input")
}
