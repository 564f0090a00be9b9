//! E0526: the output folder was not written by this machine, and has changed since.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0526",
    title: "the output folder was not written by this machine, and changed since",
    explanation: r#"The output folder has a list of generated files, `.sensedsl-files`, which this machine did not write:
the folder was cloned, copied, or is of an earlier version. What the list says of a file then counts
only where the file still is what was generated, by its SHA-256. The files that the message names are
not: somebody changed them, a tool changed their line ends, or the list is not a list of `generate`'s.
`generate` would replace or remove them.

Way out: look at the files. If all that the list names was generated, say so once with `--adopt`;
else move your files away, or choose another folder."#,
});

/// `files` lists some of the files.
pub fn unproved_files(span: Span, folder: &str, files: &str) -> Diagnostic {
    let message = format!(
        "`{folder}` was not written by this machine, and these files are not as they were generated: {files}"
    );
    Diagnostic::new(CODE, span, message)
        .help("`--adopt` replaces or removes them; else move what is yours away")
}
