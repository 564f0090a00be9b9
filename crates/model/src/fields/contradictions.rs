//! Properties that contradict another one, or what they stand in: their places in, diagnostics out.

use sensedsl_diagnostics::Span;
use sensedsl_diagnostics::codes::e0222_contradiction;
use sensedsl_wire::Direction;

use super::Fields;

impl Fields<'_> {
    /// Reports that the property at `here` contradicts another one.
    pub(crate) fn contradiction(&mut self, here: Span, other: &str, message: &str) {
        let other_span = self.value_span(other).unwrap_or(self.owner_span);
        self.diagnostics.push(e0222_contradiction::contradiction(
            here,
            message,
            other_span,
            &format!("`{other}`"),
            "change or remove one of the two",
        ));
    }

    /// Reports a property that only arrays can have.
    pub(crate) fn needs_array(&mut self, here: Span, name: &str) {
        let message = format!("`{name}` is for arrays only");
        let help = "remove the line, or make it an array: `returns uint16[4]`";
        self.useless(here, &message, "this device has one value", help);
    }

    /// Reports a property that only sensors, or only actuators, can have.
    pub(crate) fn needs_direction(&mut self, here: Span, name: &str, direction: Direction) {
        let message = format!("`{name}` is for {}s only", direction.name());
        self.useless(here, &message, "this device is none", "remove the line");
    }

    fn useless(&mut self, here: Span, message: &str, device: &str, help: &str) {
        let report = e0222_contradiction::contradiction;
        let report = report(here, message, self.owner_span, device, help);
        self.diagnostics.push(report.remove("remove the line", here));
    }
}
