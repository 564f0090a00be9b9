//! W0804: something of the source is left out.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "W0804",
    title: "something of the source is left out",
    explanation: r#"A cell, row, sheet or line of the source is not in the result: it names no pin, is a date or an error value
where a name belongs, stands beside the table, or says something that a table or a `.sense` file cannot say.

Way out: look at the place; correct the source and import again, or correct the result by hand."#,
});

/// `place` is the place as its program shows it (`Sheet1!C3`; may be empty), `what` is what is left out.
pub fn import_dropped(span: Span, place: &str, what: &str) -> Diagnostic {
    let place = if place.is_empty() { String::new() } else { format!("{place}: ") };
    Diagnostic::new(CODE, span, format!("{place}{what}"))
        .help("correct the source and import again, or correct the result by hand")
}
