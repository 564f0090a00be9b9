//! E0316: a fixed pin is taken.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0316",
    title: "a fixed pin is taken",
    explanation: r#"The pin is reserved by a rule, carries an on-board part, belongs to the link, or is one that the MCU
needs for itself: a pin of the debugger, the reset input, or a BOOT pin, which it reads at reset.

Way out: choose another pin, or `release` it where the part is not needed or the pin may be used."#,
});

/// `by` is what has the pin, `place` where that is stated, `release` a board that can release the pin, with its name there.
pub fn pin_not_available(
    (span, pin): (Span, &str),
    by: &str,
    place: Option<Span>,
    help: &str,
    release: Option<(Span, &str)>,
) -> Diagnostic {
    let diagnostic = Diagnostic::new(CODE, span, format!("{pin} is taken by {by}"))
        .here("fixed here")
        .help(help)
        .label(place, "taken here")
        .remove("remove the line and let the tool choose", span);
    match release {
        Some((board, name)) => diagnostic.add(board, &format!("release {name};")),
        None => diagnostic,
    }
}
