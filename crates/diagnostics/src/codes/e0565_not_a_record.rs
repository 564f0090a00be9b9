//! E0565: a file is no record that can be read.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0565",
    title: "no record that can be read",
    explanation: r#"A record is an MCAP file that `sensedsl monitor --record FILE` has written: it describes its boards in an attachment
`schema.json`. The file is something else, describes no board, or was changed or damaged after it was written. A record
that merely ends early is read up to its last whole chunk.

Way out: name another file. What a damaged record has before the damage is shown by other programs that read MCAP, such
as `mcap recover`. Bytes of a board without times (what `simulate --frames` writes) are shown with the design:
`sensedsl monitor FILE DESIGN.sense`."#,
});

/// It cannot be read.
pub fn not_a_record(span: Span, file: &str, why: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("{file} cannot be read as a record: {why}"))
        .help("name a file that `sensedsl monitor --record FILE` has written")
}

/// None of its boards is wanted.
pub fn other_boards(span: Span, file: &str, wanted: &str, boards: &[&str]) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("{file} is no record of `{wanted}`"))
        .help(format!("it is of {}", boards.join(", ")))
}

/// It has no board or device of that name.
pub fn no_such_name(span: Span, file: &str, name: &str, all: &[String]) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("{file} has no `{name}`")).help(format!("it has {}", all.join(", ")))
}
