//! E0312: the board has no such side or header.

use super::{Code, CodeInfo, Diagnostic, Span};
use crate::suggest::spelled;

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0312",
    title: "the board has no such side or header",
    explanation: r#"`side` and `header` are names from the columns Side and Header of the board's table.

Way out: use one of the names that the message lists, or add the column to the table."#,
});

/// `what` is "side" or "header"; `names` are those of the table.
pub fn unknown_place(span: Span, what: &str, name: &str, names: &[String]) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("no pin of the board is on the {what} `{name}`"))
        .help(if names.is_empty() {
            format!("the board's table has no column `{what}`: add one")
        } else {
            format!("use one of {}", names.join(", "))
        })
        .one_of(names.iter().map(|name| spelled(name)).collect::<Vec<_>>().iter().map(String::as_str))
}
