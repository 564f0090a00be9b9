//! Soft rules: which candidates violate which `prefer` or `avoid`.
//!
//! A rule counts once for each device that violates it; a board's rule is read as if it were
//! written in each device on that board.

use std::collections::BTreeSet;

use sensedsl_board::signal::{Function, UnitName};
use sensedsl_board::table::{Pin, Usage};
use sensedsl_model::design::{BoardIndex, Design, PartIndex, Preference, PreferenceSubject};
use sensedsl_model::kind::Role;
use sensedsl_solve::problem::{Device, RuleId};

use crate::builder::{Builder, Meaning, Rule};
use crate::offer::Offer;
use crate::requested::RequestedWires;

/// The soft rules for one device.
pub(crate) struct Rules<'a> {
    rules: Vec<Rule<'a>>,
    single: bool,
    /// The unit that the device fixes.
    unit: Option<&'a str>,
}

/// Collects the rules for a device: its own, and those of the boards it may go to.
pub(crate) fn rules<'a>(builder: &mut Builder<'a>, wanted: &RequestedWires<'a>) -> Rules<'a> {
    // The connections of a part share them: each counts once, however many violate it.
    let known = wanted.part.map(|part| builder.rules_of(part)).unwrap_or_default();
    let rules = if known.is_empty() { number(builder, wanted) } else { known };
    if let Some(part) = wanted.part {
        builder.remember_rules(part, &rules);
    }
    let of_chip =
        wanted.part.is_some_and(|part| builder.design.connections_of(part).nth(1).is_some());
    let one_wire = wanted.kind.roles(wanted.direction).len() == 1;
    let single = one_wire && !wanted.is_element && !of_chip;
    Rules { rules, single, unit: wanted.unit }
}

fn number<'a>(builder: &mut Builder<'a>, wanted: &RequestedWires<'a>) -> Vec<Rule<'a>> {
    let mut rules = Vec::new();
    for wish in wanted.wishes {
        rules.push((builder.rule(), None, wish));
    }
    for index in &wanted.boards {
        let design = builder.design;
        let Some(board) = design.board(*index) else { continue };
        for wish in &board.wishes {
            rules.push((builder.rule(), Some(*index), wish));
        }
    }
    rules
}

/// For a chip with several connections, a `prefer unit` applies to those that could have the unit
/// on the board in question; if none could, it applies to all.
pub(crate) fn leave_out_others(
    builder: &Builder<'_>,
    part: PartIndex,
    devices: &mut [Device],
    meanings: &[Vec<Meaning>],
) {
    let design = builder.design;
    for (rule, _, wish) in builder.rules_of(part) {
        let PreferenceSubject::Unit(wanted) = &wish.what else { continue };
        let mut could: Vec<BTreeSet<BoardIndex>> = Vec::new();
        for ways in meanings {
            let with = ways.iter().filter(|meaning| has_unit(design, meaning, wanted));
            could.push(with.map(|meaning| meaning.board).collect());
        }
        let any: BTreeSet<BoardIndex> = could.iter().flatten().copied().collect();
        for ((device, ways), could) in devices.iter_mut().zip(meanings).zip(&could) {
            for (alternative, meaning) in device.alternatives.iter_mut().zip(ways) {
                if any.contains(&meaning.board) && !could.contains(&meaning.board) {
                    alternative.violates.retain(|one| *one != rule);
                    let roles = alternative.roles.iter_mut();
                    let candidates = roles.flat_map(|role| &mut role.candidates);
                    candidates.for_each(|one| one.violates.retain(|one| *one != rule));
                }
            }
        }
    }
}

/// Whether the unit could serve a connection that is connected in this way.
fn has_unit(design: &Design, meaning: &Meaning, wanted: &str) -> bool {
    let Some(board) = design.board(meaning.board) else { return false };
    if let Some(unit) = &meaning.unit {
        return board.same_unit(wanted, unit);
    }
    meaning.roles.iter().flatten().any(|at| {
        let usage = board.table.pins.get(at.pin).zip(at.usage);
        let usage = usage.and_then(|(pin, usage)| pin.usages.get(usage));
        let units = usage.map(|usage| usage.signal.function().units()).unwrap_or_default();
        units.iter().any(|unit| board.same_unit(wanted, unit.as_str()))
    })
}

impl Rules<'_> {
    fn on(&self, board: BoardIndex) -> impl Iterator<Item = (RuleId, &Preference)> {
        let here = move |bound: Option<BoardIndex>| bound.is_none_or(|bound| bound == board);
        let rules = self.rules.iter().filter(move |(_, bound, _)| here(*bound));
        rules.map(|(id, _, wish)| (*id, *wish))
    }

    /// The rules that one wire on this pin violates.
    pub(crate) fn violated_by(
        &self,
        offer: &Offer<'_>,
        role: Role,
        pin: &Pin,
        usage: Option<&Usage>,
        channels: Channels,
    ) -> Vec<RuleId> {
        let violated = |wish: &Preference| match &wish.what {
            PreferenceSubject::Pin(Some(of), _) if *of != role => false,
            // One pin for a device of several wires: nothing to prefer, but something to avoid.
            PreferenceSubject::Pin(None, _) if wish.prefer && !self.single => false,
            PreferenceSubject::Pin(_, name) => {
                (name.on(offer.index) == Some(&pin.name)) != wish.prefer
            }
            PreferenceSubject::Side(side) => {
                pin.places.iter().any(|place| place.is_at_side(side)) != wish.prefer
            }
            PreferenceSubject::Header(header) => {
                pin.places.iter().any(|place| place.is_at_header(header)) != wish.prefer
            }
            PreferenceSubject::Unit(unit) => {
                self.wire_violates(offer, (usage, channels), unit, wish.prefer)
            }
            // They are kept or violated by the array as a whole.
            PreferenceSubject::Together(_) | PreferenceSubject::Sequence => false,
        };
        self.on(offer.index).filter(|(_, wish)| violated(wish)).map(|(id, _)| id).collect()
    }

    /// The rules that taking this peripheral instance violates.
    pub(crate) fn violated_by_unit(&self, offer: &Offer<'_>, unit: Option<&str>) -> Vec<RuleId> {
        let Some(unit) = unit else { return Vec::new() };
        let violated = |wish: &Preference| match &wish.what {
            PreferenceSubject::Unit(wanted) => offer.same_unit(wanted, unit) != wish.prefer,
            PreferenceSubject::Pin(..)
            | PreferenceSubject::Side(_)
            | PreferenceSubject::Header(_)
            | PreferenceSubject::Together(_)
            | PreferenceSubject::Sequence => false,
        };
        self.on(offer.index).filter(|(_, wish)| violated(wish)).map(|(id, _)| id).collect()
    }

    /// Converters and single channels are not chosen as instances, so the wire itself decides: it
    /// violates a `prefer` if that instance cannot have it, and an `avoid` if no other can. If an
    /// instance is fixed, only that one of those that can have it counts.
    fn wire_violates(
        &self,
        offer: &Offer<'_>,
        (usage, channels): (Option<&Usage>, Channels),
        unit: &str,
        prefer: bool,
    ) -> bool {
        let Some(usage) = usage else { return false };
        let units = match usage.signal.function() {
            Function::Adc { .. } | Function::Dac { .. } => usage.signal.function().units(),
            Function::Timer { .. } if channels == Channels::Single => {
                usage.signal.function().units()
            }
            Function::Timer { .. }
            | Function::I2c { .. }
            | Function::Uart { .. }
            | Function::Spi { .. }
            | Function::Can { .. }
            | Function::Pio { .. }
            | Function::Other => return false,
        };
        let counts = |one: &str| self.unit.is_none_or(|fixed| offer.same_unit(fixed, one));
        let mut units = units.iter().map(UnitName::as_str).filter(|one| counts(one));
        units.all(|one| offer.same_unit(unit, one) != prefer)
    }
}

/// How a device takes the channels of a timer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Channels {
    /// One by one: only the wire tells which timer it is.
    Single,
    /// With the whole timer, which the alternative names.
    OfWholeTimer,
}
