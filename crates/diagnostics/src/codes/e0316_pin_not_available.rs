//! E0316: a fixed pin is taken.

use crate::codes::{Code, CodeInfo};
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;

/// The registry entry.
pub const INFO: CodeInfo = CodeInfo {
    code: "E0316",
    severity: Severity::Error,
    title: "a fixed pin is taken",
    explanation: r#"The pin is reserved by a rule, carries an on-board part, belongs to the link, or is one that the MCU
needs for itself: a pin of the debugger, the reset input, or a BOOT pin, which it reads at reset.

Way out: choose another pin, or `release` it where the part is not needed or the pin may be used.
"#,
};

/// The code.
pub const CODE: Code = Code(&INFO);

/// `by` is what has the pin, `place` where that is stated.
#[must_use]
pub fn pin_not_available(span: Span, pin: &str, by: &str, place: Option<Span>, help: &str) -> Diagnostic {
    let diagnostic = Diagnostic::new(CODE, span, format!("{pin} is taken by {by}")).here("fixed here").help(help);
    match place {
        Some(place) => diagnostic.label(place, "taken here"),
        None => diagnostic,
    }
}
