//! W0612: bare numbers that were codes in older files.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "W0612",
    title: "a bare number is the shown value, and was a code before",
    explanation: r#"A bare number that is given for a device with `scale`, `offset` or `curve` is the value that is shown. Up to
version 0.1 it was the code that goes over the wire, so that a file from before now means something
else. This is said once for a file, at the first such number.

Way out: `sensedsl fmt --migrate FILE` writes what the file meant before (`raw 307`). Where the shown
value is meant, write its unit (`1500 us`), which says so; where the unit is none of the language's,
`allow W0612 "the shown value is meant";`."#,
});

/// `shown` is the number as shown, `code` the code that it is, `more` how many more there are in the file, `write` what
/// to write if the shown value is meant; `ways` are what can be written for the shown value and for the code.
pub fn shown_not_raw(
    span: Span,
    (shown, code): (&str, &str),
    more: usize,
    write: &str,
    ways: [Option<&str>; 2],
) -> Diagnostic {
    let others = match more {
        0 => String::new(),
        1 => ", and so is one more number of this file".to_owned(),
        more => format!(", and so are {more} more numbers of this file"),
    };
    let message = format!("{shown} is the shown value, code {code}{others}; before it was the code itself");
    Diagnostic::new(CODE, span, message)
        .here("in the unit that is shown")
        .help(format!("{write}; `sensedsl fmt --migrate FILE` writes what an older file meant"))
        .one_of(ways.into_iter().flatten())
}
