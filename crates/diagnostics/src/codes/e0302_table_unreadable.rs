//! E0302: a board table cannot be read.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0302",
    title: "a board table cannot be read",
    explanation: r#"The table named after `on`, or by `--board`, is a CSV file; the path after `on` is relative to the file
that holds it.

Way out: correct the path, or export the spreadsheet as CSV (UTF-8)."#,
});

/// `why` is the reason why the table at `path` cannot be read.
pub fn table_unreadable(span: Span, path: &str, why: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("cannot read the table `{path}`: {why}"))
        .help("the path is relative to the file that holds it; the table is a CSV file in UTF-8")
}

/// The name of a built-in board or a part where a path is expected.
pub fn board_in_quotes(span: Span, name: &str) -> Diagnostic {
    let word = name.replace('-', "_");
    Diagnostic::new(CODE, span, format!("there is no table `{name}`, but a board or part of that name"))
        .help(format!("write `on {word}`: what is in quotes is the path of a table"))
        .replace(format!("change to `{word}`"), span, word)
}
