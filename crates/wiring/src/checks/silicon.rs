//! Devices that the silicon of no board in question can serve as they are placed: from a device,
//! the report with the reason.

use sensedsl_board::signal::Function;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_diagnostics::codes::e0320_silicon_cannot;
use sensedsl_model::kind::Kind;

use super::{Fixed, Placed};
use crate::alternatives::served;
use crate::alternatives::timers::{Channel, channel};
use crate::offer::Offer;

/// Whether something else than a timer can serve the kind on the board: a state machine, or handlers of interrupts.
fn has_substitute(kind: &Kind, offer: &Offer<'_>) -> bool {
    let served = served(kind);
    let has_handlers = offer.board.profile().is_some_and(|profile| profile.edges.is_some());
    (served.takes_machines() && has_machines(offer)) || (served.takes_handlers() && has_handlers)
}

/// Whether the board's system programs state machines, and pins name them.
fn has_machines(offer: &Offer<'_>) -> bool {
    let is_programmed = offer.board.profile().is_some_and(|profile| !profile.pios.is_empty());
    let mut usages = offer.pins().flat_map(|(_, pin)| &pin.usages);
    is_programmed && usages.any(|usage| matches!(usage.signal.function(), Function::Pio { .. }))
}

impl Placed<'_> {
    /// The report for a kind that the silicon of no board in question supports.
    pub(super) fn without_silicon(&self) -> Option<Diagnostic> {
        let unable = self.offers.iter().map(|offer| {
            let ability = served(&self.wires.kind).ability(offer.board)?;
            (ability.channels.is_empty() && !has_substitute(&self.wires.kind, offer))
                .then_some((ability, offer.board.mcu.as_deref()?))
        });
        let all: Option<Vec<_>> = unable.collect();
        let (ability, mcu) = all?.into_iter().next()?;
        let (name, kind) =
            (&self.design.part(self.wires.part)?.name, self.wires.kind.name().with_article());
        let because = &ability.because;
        Some(e0320_silicon_cannot::silicon_cannot(name.span, &name.value, &kind, mcu, because))
    }

    /// The reason why a timer that a board has cannot do what the device needs on any pin.
    pub(super) fn unit_lacks(&self, unit: &str) -> Option<&'static str> {
        self.offers.iter().find_map(|offer| {
            let ability = served(&self.wires.kind).ability(offer.board)?;
            let usages = offer.pins().flat_map(|(_, pin)| &pin.usages);
            let of_unit = |one: &Channel<'_>| offer.same_unit(unit, one.unit.as_str());
            let mut channels = usages.filter_map(channel).filter(of_unit).peekable();
            channels.peek()?;
            (!channels.any(|one| one.captures(Some(ability)))).then_some(ability.because.as_str())
        })
    }

    /// The report for a fixed pin that cannot carry a digital signal, or not in the direction of the wire.
    pub(super) fn no_gpio(&self, (role, pin): &Fixed) -> Option<Diagnostic> {
        let because = self.offers.iter().find_map(|offer| {
            let row = pin.value.on(offer.index).and_then(|name| offer.board.table.pin(name))?;
            let because = if offer.is_analog_only(row) {
                "the pad is an input of the converter alone"
            } else {
                "the pad is an input alone"
            };
            (!offer.is_gpio(row, *role)).then_some(because)
        })?;
        let (needs, pins) = self.needs_and_pins(*role);
        let name = pin.value.shown();
        Some(e0320_silicon_cannot::channel_cannot(pin.span, &name, &needs, because, &pins))
    }

    /// The report for a fixed pin on a channel that the silicon cannot use in this way.
    pub(super) fn by_silicon(&self, (role, pin): &Fixed) -> Option<Diagnostic> {
        if let Some(report) = self.without_silicon() {
            return Some(report);
        }
        let without = self.offers.iter().filter(|offer| !has_substitute(&self.wires.kind, offer));
        let ability = without.into_iter().find_map(|offer| {
            let ability = served(&self.wires.kind).ability(offer.board)?;
            let usages = &offer.board.table.pin(pin.value.on(offer.index)?)?.usages;
            let mut channels = usages.iter().filter_map(channel);
            channels.any(|channel| !channel.captures(Some(ability))).then_some(ability)
        })?;
        let (needs, pins) = self.needs_and_pins(*role);
        let name = pin.value.shown();
        Some(e0320_silicon_cannot::channel_cannot(pin.span, &name, &needs, &ability.because, &pins))
    }
}
