//! E0314: a fixed pin cannot serve the device.

use super::{Code, CodeInfo, Diagnostic, Span};
use crate::diagnostic::{Edit, Fix, Scope};
use crate::suggest::spelled;

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0314",
    title: "a fixed pin cannot serve the device",
    explanation: r#"The pin is in the board's table, but none of its usages is what the device needs at that place.

Way out: take one of the pins that the message lists, or leave the choice to the tool."#,
});

/// Two pins of a device that would fit if they were swapped, each as the file names it; `shown` is the first one for
/// people, `needs` is what its role needs, `lines` has both lines corrected.
pub fn pins_swapped(
    (span, pin): (Span, &str),
    (other, its_pin): (Span, &str),
    (shown, needs): (&str, &str),
    lines: &str,
) -> Diagnostic {
    let edit = |span, name: &str| Edit { span, text: spelled(name), scope: Scope::Text };
    let edits = vec![edit(span, its_pin), edit(other, pin)];
    let mut diagnostic = Diagnostic::new(CODE, span, format!("{shown} cannot be {needs}"))
        .here("fixed here")
        .label(other, "and the other one here")
        .help(format!("the two are swapped: write `{lines}`"));
    diagnostic.fixes.push(Fix { title: "swap the two".to_owned(), edits });
    diagnostic
}

/// `needs` is what the role needs, `row` the place of the pin's usages, `pins` lists the pins that fit.
pub fn pin_cannot_serve(span: Span, pin: &str, needs: &str, row: Option<Span>, pins: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("{pin} cannot be {needs}"))
        .here("fixed here")
        .help(if pins.is_empty() {
            format!("no pin of the board can be {needs}")
        } else {
            format!("take one of {pins}, or remove the line and let the tool choose")
        })
        .label(row, "all its usages")
        .remove("remove the line and let the tool choose", span)
}
