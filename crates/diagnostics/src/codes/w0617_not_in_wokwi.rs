//! W0617: a part is not in the diagram for Wokwi.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "W0617",
    title: "a part is not in the diagram for Wokwi",
    explanation: r#"`solve --format wokwi` draws the parts that Wokwi has, and stand-ins for plain levels and voltages: a potentiometer, a
switch, an LED. Nothing there answers as this part does, so it was left out, with its wires. A note in the diagram says
which pins they would go to. The wiring itself is complete.

Way out: write the part for Wokwi as a custom chip (https://docs.wokwi.com/chips-api/getting-started) and connect it to
the pins that the note says, or simulate the design with `sensedsl simulate`, which has all parts of the library."#,
});

/// `why` says why `part` is not there; a clause.
pub fn not_in_wokwi(span: Span, part: &str, why: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{part}` is left out of the diagram: {why}")).help(
        "the diagram has a note with its pins: connect a custom chip of yours to them, or run `sensedsl simulate`",
    )
}
