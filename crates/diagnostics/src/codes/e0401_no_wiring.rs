//! E0401: there is no wiring.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0401",
    title: "there is no wiring",
    explanation: r#"The devices that the message names cannot all be connected, whatever pins are chosen, and the set is
minimal: without any one of them the others can. The message lists the pins and resources they fight
for; a resource is more than a pin: a whole timer, a bus, a DMA stream, an interrupt line. Marked with
"because of this" are the rules without which it would work: a minimal set as well where up to 256
rules apply to these devices; of more, those beyond are marked without having been tried. Where time
ran out before all that was known, the message says so.

Way out: one of the changes that the message proposes; each was tried by solving. Otherwise drop or
move one of the devices, or use a kind that needs something else."#,
});

/// `devices` lists the devices, `resources` the resources that they compete for.
pub fn no_wiring(span: Span, devices: &str, resources: &str) -> Diagnostic {
    let diagnostic = Diagnostic::new(CODE, span, format!("no wiring: {devices} cannot be connected together"));
    if resources.is_empty() {
        diagnostic
    } else {
        diagnostic.here(format!("fights for {resources}"))
    }
}

/// A single device: no pins of the board are what it needs.
pub fn nothing_serves(span: Span, device: &str, resources: &str) -> Diagnostic {
    let message = format!("no wiring: no free pins of the board can serve {device}");
    let diagnostic = Diagnostic::new(CODE, span, message);
    if resources.is_empty() {
        diagnostic
    } else {
        diagnostic.here(format!("needs {resources}"))
    }
}
