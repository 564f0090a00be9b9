//! Which pins of a board devices may have at all, and why the others may not.

use std::collections::BTreeMap;

use sensedsl_board::pin::PinName;
use sensedsl_board::profile::{self, TargetProfile};
use sensedsl_board::table::{Occupation, Pin};
use sensedsl_diagnostics::Span;
use sensedsl_model::design::{Board, BoardIndex, Transport};

/// Why a pin is not offered.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Withheld {
    /// By a `reserve` rule.
    Reserved(Span),
    /// An on-board part has it.
    Onboard(String),
    /// The link to the host has it.
    Link,
    /// The debugger has it.
    Debug,
}

/// A board and its pins as devices may use them.
pub(crate) struct Offer<'a> {
    pub(crate) index: BoardIndex,
    pub(crate) board: &'a Board,
    /// For each pin of the table why it is withheld.
    withheld: Vec<Option<Withheld>>,
    /// For each pin of the table the contact that it shares with others.
    pads: Vec<Option<String>>,
}

impl<'a> Offer<'a> {
    pub(crate) fn new(index: BoardIndex, board: &'a Board) -> Self {
        let mut withheld: Vec<_> =
            board.table.pins.iter().map(|pin| withheld(board, pin)).collect();
        let pads = shared_pads(&board.table.pins);
        keep_pads_free(board, &pads, &mut withheld);
        Self { index, board, withheld, pads }
    }

    /// The contact of a pin where other pins are on it as well.
    pub(crate) fn shared_pad(&self, pin: usize) -> Option<&str> {
        self.pads.get(pin)?.as_deref()
    }

    pub(crate) fn why_withheld(&self, pin: usize) -> Option<&Withheld> {
        self.withheld.get(pin)?.as_ref()
    }

    /// The pins that are offered, with their index in the table.
    pub(crate) fn pins(&self) -> impl Iterator<Item = (usize, &'a Pin)> {
        let pins = self.board.table.pins.iter().enumerate();
        pins.filter(|(index, _)| self.why_withheld(*index).is_none())
    }

    /// True when an on-board part leaves the pin to further devices of its bus only.
    pub(crate) fn bus_only(&self, pin: &Pin) -> bool {
        let on_bus = pin.onboard.as_ref().is_some_and(|part| part.how == Occupation::Bus);
        on_bus && !released(self.board, pin)
    }

    /// True when a rule keeps the peripheral instance free.
    pub(crate) fn unit_reserved(&self, unit: &str) -> bool {
        self.board.reserved.iter().any(|reserved| reserved.value == unit)
    }
}

/// The place of each pin where it is not the only one there. A place is a position of the package,
/// or of a connector.
fn shared_pads(pins: &[Pin]) -> Vec<Option<String>> {
    let place = |pin: &Pin| {
        let position = pin.position.as_deref()?;
        Some(
            pin.header
                .as_ref()
                .map_or(position.to_owned(), |header| format!("{header}.{position}")),
        )
    };
    let mut count: BTreeMap<String, usize> = BTreeMap::new();
    for place in pins.iter().filter_map(place) {
        *count.entry(place).or_default() += 1;
    }
    pins.iter()
        .map(|pin| place(pin).filter(|place| count.get(place).is_some_and(|n| *n > 1)))
        .collect()
}

/// What withholds a pin withholds all others on its contact, but those that a rule releases.
fn keep_pads_free(board: &Board, pads: &[Option<String>], withheld: &mut [Option<Withheld>]) {
    let reasons: BTreeMap<&str, Withheld> = pads
        .iter()
        .zip(withheld.iter())
        .filter_map(|(pad, why)| Some((pad.as_deref()?, why.clone()?)))
        .collect();
    for ((pad, why), pin) in pads.iter().zip(withheld).zip(&board.table.pins) {
        let released = board
            .released
            .iter()
            .any(|rule| PinName::parse(&rule.value).is_some_and(|name| name == pin.name));
        if why.is_none() && !released {
            *why = pad.as_deref().and_then(|pad| reasons.get(pad)).cloned();
        }
    }
}

/// Whether a rule gives the pin free from its on-board part.
fn released(board: &Board, pin: &Pin) -> bool {
    let part = pin.onboard.as_ref().map(|part| part.part.as_str());
    board.released.iter().any(|rule| {
        PinName::parse(&rule.value).is_some_and(|name| name == pin.name)
            || part.is_some_and(|part| part.eq_ignore_ascii_case(&rule.value))
    })
}

fn withheld(board: &Board, pin: &Pin) -> Option<Withheld> {
    let named = |name: &str| PinName::parse(name).is_some_and(|name| name == pin.name);
    if let Some(rule) = board.reserved.iter().find(|rule| named(&rule.value)) {
        return Some(Withheld::Reserved(rule.span));
    }
    let profile = board.profile();
    if profile.is_some_and(|profile| is_of_usb_link(board, profile, pin)) {
        return Some(Withheld::Link);
    }
    // The part at the other end of a wired link is what the link talks to.
    if released(board, pin) || board.link.pins.contains(&pin.name) {
        return None;
    }
    if let Some(part) = &pin.onboard
        && part.how == Occupation::Taken
    {
        return Some(Withheld::Onboard(part.part.clone()));
    }
    profile?.debug.pins.contains(&pin.name).then_some(Withheld::Debug)
}

/// Whether the link to the host takes the pin: no rule can give it away.
fn is_of_usb_link(board: &Board, profile: &TargetProfile, pin: &Pin) -> bool {
    if board.link.transport != Transport::Usb {
        return false;
    }
    let links = board.facts.iter().flat_map(|facts| &facts.link);
    let mut links = links.filter(|link| link.transport == profile::Transport::Usb);
    profile.link_pins(profile::Transport::Usb, None).contains(&pin.name)
        || links.any(|link| link.pins.contains(&pin.name))
}
