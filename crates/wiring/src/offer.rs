//! Which pins of a board devices may have at all, and why the others may not.

use sensedsl_board::pin::PinName;
use sensedsl_board::profile;
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
}

impl<'a> Offer<'a> {
    pub(crate) fn new(index: BoardIndex, board: &'a Board) -> Self {
        let withheld = board.table.pins.iter().map(|pin| withheld(board, pin)).collect();
        Self { index, board, withheld }
    }

    pub(crate) fn why_withheld(&self, pin: usize) -> Option<&Withheld> {
        self.withheld.get(pin)?.as_ref()
    }

    /// The pins that are offered, with their index in the table.
    pub(crate) fn pins(&self) -> impl Iterator<Item = (usize, &'a Pin)> {
        let pins = self.board.table.pins.iter().enumerate();
        pins.filter(|(index, _)| self.why_withheld(*index).is_none())
    }

    /// True when a rule keeps the peripheral instance free.
    pub(crate) fn unit_reserved(&self, unit: &str) -> bool {
        self.board.reserved.iter().any(|reserved| reserved.value == unit)
    }
}

fn withheld(board: &Board, pin: &Pin) -> Option<Withheld> {
    let named = |name: &str| PinName::parse(name).is_some_and(|name| name == pin.name);
    if let Some(rule) = board.reserved.iter().find(|rule| named(&rule.value)) {
        return Some(Withheld::Reserved(rule.span));
    }
    let part = pin.onboard.as_ref();
    let released = board.released.iter().any(|rule| {
        named(&rule.value) || part.is_some_and(|part| part.part.eq_ignore_ascii_case(&rule.value))
    });
    if released {
        return None;
    }
    if let Some(part) = part
        && part.how == Occupation::Taken
    {
        return Some(Withheld::Onboard(part.part.clone()));
    }
    let profile = board.profile()?;
    if profile.debug.pins.contains(&pin.name) {
        return Some(Withheld::Debug);
    }
    let usb = board.link.transport == Transport::Usb;
    let of_chip = profile.link_pins(profile::Transport::Usb, None).contains(&pin.name);
    let of_board = || {
        let links = board.facts.iter().flat_map(|facts| &facts.link);
        let mut links = links.filter(|link| link.transport == profile::Transport::Usb);
        links.any(|link| link.pins.contains(&pin.name))
    };
    (usb && (of_chip || of_board())).then_some(Withheld::Link)
}
