//! Soft rules: which candidates violate which `prefer` or `avoid`.
//!
//! A rule counts once for each device it is violated by; a board's rule is read as if it stood in
//! each device on that board.

use sensedsl_board::signal::{Function, UnitName};
use sensedsl_board::table::{Pin, Usage};
use sensedsl_model::design::{BoardIndex, Wish, WishFor};
use sensedsl_model::kind::Role;
use sensedsl_solve::problem::RuleId;

use crate::alternatives::Wanted;
use crate::formulate::Builder;
use crate::offer::Offer;

/// A soft rule, with the board that it is bound to where it stands in one.
pub(crate) type Rule<'a> = (RuleId, Option<BoardIndex>, &'a Wish);

/// The soft rules for one device.
pub(crate) struct Rules<'a> {
    rules: Vec<Rule<'a>>,
    single: bool,
    /// The unit that the device fixes.
    unit: Option<&'a str>,
}

/// Collects the rules for a device: its own, and those of the boards it may go to.
pub(crate) fn rules<'a>(builder: &mut Builder<'a>, wanted: &Wanted<'a>) -> Rules<'a> {
    // The connections of a part have them in common: each counts once, however many violate it.
    let known = wanted.part.map(|part| builder.rules_of(part)).unwrap_or_default();
    let rules = if known.is_empty() { number(builder, wanted) } else { known };
    if let Some(part) = wanted.part {
        builder.remember_rules(part, &rules);
    }
    let single = wanted.kind.roles(wanted.direction).len() == 1 && !wanted.is_element;
    Rules { rules, single, unit: wanted.unit }
}

fn number<'a>(builder: &mut Builder<'a>, wanted: &Wanted<'a>) -> Vec<Rule<'a>> {
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

impl Rules<'_> {
    fn on(&self, board: BoardIndex) -> impl Iterator<Item = (RuleId, &Wish)> {
        let here = move |bound: Option<BoardIndex>| bound.is_none_or(|bound| bound == board);
        let rules = self.rules.iter().filter(move |(_, bound, _)| here(*bound));
        rules.map(|(id, _, wish)| (*id, *wish))
    }

    /// The rules that one wire on that pin violates.
    pub(crate) fn violated_by(
        &self,
        offer: &Offer<'_>,
        role: Role,
        pin: &Pin,
        usage: Option<&Usage>,
        channels: Channels,
    ) -> Vec<RuleId> {
        let place = |has: &Option<String>, wanted: &str| {
            has.as_deref().is_some_and(|has| has.eq_ignore_ascii_case(wanted))
        };
        let violated = |wish: &Wish| match &wish.what {
            WishFor::Pin(Some(of), _) if *of != role => false,
            // One pin for a device of several wires: nothing to prefer, but something to avoid.
            WishFor::Pin(None, _) if wish.prefer && !self.single => false,
            WishFor::Pin(_, name) => (name.on(offer.index) == Some(&pin.name)) != wish.prefer,
            WishFor::Side(side) => place(&pin.side, side) != wish.prefer,
            WishFor::Header(header) => place(&pin.header, header) != wish.prefer,
            WishFor::Unit(unit) => self.wire_violates(offer, (usage, channels), unit, wish.prefer),
            // They are kept or violated by the array as a whole.
            WishFor::Together(_) | WishFor::Sequence => false,
        };
        self.on(offer.index).filter(|(_, wish)| violated(wish)).map(|(id, _)| id).collect()
    }

    /// The rules that taking that peripheral instance violates.
    pub(crate) fn violated_by_unit(&self, offer: &Offer<'_>, unit: Option<&str>) -> Vec<RuleId> {
        let Some(unit) = unit else { return Vec::new() };
        let violated = |wish: &Wish| match &wish.what {
            WishFor::Unit(wanted) => offer.same_unit(wanted, unit) != wish.prefer,
            WishFor::Pin(..)
            | WishFor::Side(_)
            | WishFor::Header(_)
            | WishFor::Together(_)
            | WishFor::Sequence => false,
        };
        self.on(offer.index).filter(|(_, wish)| violated(wish)).map(|(id, _)| id).collect()
    }

    /// Converters and single channels are not chosen as instances, so the wire itself tells: it
    /// violates a `prefer` when that instance cannot have it, an `avoid` when no other can. Of the
    /// instances that can have it a fixed one alone counts.
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
    /// One by one: the wire alone tells which timer it is.
    Single,
    /// With the whole timer, which the alternative names.
    OfWholeTimer,
}
