//! E0314: a fixed pin cannot serve the device.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0314",
    title: "a fixed pin cannot serve the device",
    explanation: r#"The pin is in the board's table, but none of its usages is what the device needs at that place.

Way out: take one of the pins that the message lists, or leave the choice to the tool."#,
});

/// Two pins of a device that would fit if they were swapped; `needs` is what their roles need, `lines` has both lines
/// corrected.
pub fn pins_swapped(span: Span, pin: &str, needs: &str, other: Span, lines: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("{pin} cannot be {needs}"))
        .here("fixed here")
        .label(other, "and the other one here")
        .help(format!("the two are swapped: write `{lines}`"))
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
}
