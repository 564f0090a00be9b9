//! E0566: a record cannot be begun, or not be continued.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0566",
    title: "a record cannot be written",
    explanation: r#"`--record FILE` makes a new file. It never writes over one that is there, because a run cannot be had again, and it
needs a folder in which you may write.

A record ends early where the disk is full or takes no more: what was written until then can be read, and the run goes
on without it.

Way out: give a name that is free, such as one with the time of day: `--record run-$(date +%H%M%S).mcap`,
and make room on the disk."#,
});

/// What is said while the run goes on: the disk takes no more.
#[must_use]
pub fn ends_here(file: &str, why: &str) -> String {
    format!("the record {file} ends here: {why} ({})", CODE.name())
}

/// The file cannot be made.
pub fn not_made(span: Span, file: &str, why: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("cannot begin a record in {file}: {why}"))
        .help("give a name that is free, in a folder in which you may write")
}
