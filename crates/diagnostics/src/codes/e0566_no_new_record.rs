//! E0566: a record cannot be begun.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0566",
    title: "no new record",
    explanation: r#"`--record FILE` makes a new file. It never writes over one that is there, because a run cannot be had again, and it
needs a folder in which you may write.

Way out: give a name that is free, such as one with the time of day: `--record run-$(date +%H%M%S).mcap`."#,
});

/// The file cannot be made.
pub fn not_made(span: Span, file: &str, why: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("cannot begin a record in {file}: {why}"))
        .help("give a name that is free, in a folder in which you may write")
}
