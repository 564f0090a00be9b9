//! E0117: there are more mistakes than are listed.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0117",
    title: "there are more mistakes than are listed",
    explanation: r#"The first thousand mistakes of a design are listed. A file with more is usually not a design at all.

Way out: name the right file, or mend the mistakes that are listed and run the command again."#,
});

/// `listed` is the number of mistakes that are listed, `more` the number of the others.
pub fn more_mistakes(span: Span, listed: usize, more: usize) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("there are {more} more mistakes; {listed} are listed"))
        .help("mend those and run the command again, or name the file that is meant")
}
