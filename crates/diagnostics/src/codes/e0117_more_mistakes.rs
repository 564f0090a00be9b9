//! E0117: there are more mistakes than are listed.

use crate::codes::{Code, CodeInfo};
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;

/// The registry entry.
pub const INFO: CodeInfo = CodeInfo {
    code: "E0117",
    severity: Severity::Error,
    title: "there are more mistakes than are listed",
    explanation: r#"The first thousand mistakes of a design are listed. A file with more is usually not a design at all.

Way out: name the right file, or mend the mistakes that are listed and run the command again.
"#,
};

/// The code.
pub const CODE: Code = Code(&INFO);

/// `listed` is the number of mistakes that are listed, `more` the number of the others.
#[must_use]
pub fn more_mistakes(span: Span, listed: usize, more: usize) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("there are {more} more mistakes; {listed} are listed"))
        .help("mend those and run the command again, or name the file that is meant")
}
