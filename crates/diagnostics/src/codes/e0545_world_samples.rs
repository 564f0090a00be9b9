//! E0545: the samples of a world cannot be read.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0545",
    title: "samples that cannot be read",
    explanation: r#"`{ csv = "drive.csv", column = "speed" }` takes the values of a quantity from a file beside the world: the first line names
the columns, the first column is the time in seconds, and each further line is a point. Between points the value goes
straight from one to the next.

Way out: mend the line that the message names, or name a column that the file has."#,
});

/// The file could not be read.
pub fn unread(span: Span, file: &str, why: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("the samples in {file} were not read: {why}"))
        .help("name a CSV file beside the world, or in a folder below")
}

/// No column has this name.
pub fn no_column(span: Span, column: &str, near: Option<&str>, all: &str) -> Diagnostic {
    let report = Diagnostic::new(CODE, span, format!("the samples have no column `{column}`"));
    match near {
        Some(near) => report.help(format!("did you mean `{near}`?")),
        None => report.help(format!("their columns are {all}")),
    }
}

/// A line of the file is not as it should be.
pub fn bad_line(span: Span, file: &str, line: usize, why: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("line {line} of {file}: {why}"))
        .help("each line is a time in seconds and a number for each column")
}
