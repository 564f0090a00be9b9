//! The rules that a conflict needs: what the file fixes or reserves, what the board has soldered
//! on, what the operating system's drivers cannot do.
//!
//! The devices of a conflict are minimal with all rules in force. Rules are then lifted one by one;
//! a rule stays lifted if the devices cannot be wired without it either. What is left is minimal
//! too: without any one of the devices, or of the rules, there is a wiring.

use std::collections::BTreeSet;

use sensedsl_board::profile::Target;
use sensedsl_board::table::Occupation;
use sensedsl_diagnostics::Span;
use sensedsl_model::design::{Board, BoardIndex, Design, PartIndex, Spanned};
use sensedsl_model::kind::Role;

use crate::alternatives::served;
use crate::{Cancel, Solved, Wiring};

/// A rule that can be lifted.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Rule {
    /// The limits of the drivers of the board's operating system.
    Target(BoardIndex),
    /// An on-board part and its pins.
    Part(BoardIndex, String),
    /// A `reserve`.
    Reserve(BoardIndex, String, Span),
    /// `exclusive` of an i2c device.
    Exclusive(PartIndex),
    /// The `side` of a device.
    Side(PartIndex, Span),
    /// The `header` of a device.
    Header(PartIndex, Span),
    /// The `unit` of a device.
    Unit(PartIndex, Span),
    /// A fixed pin of a device.
    Pin(PartIndex, Role, Span),
    /// A property that the elements of an array must have in common, or their order.
    Tie(PartIndex, Span),
    /// The board in whose block a device is, if there are others.
    Board(PartIndex),
}

impl Rule {
    /// Its place in the file; `None` for a rule that is not in the file.
    #[must_use]
    pub const fn span(&self) -> Option<Span> {
        match self {
            Self::Reserve(.., span)
            | Self::Side(_, span)
            | Self::Header(_, span)
            | Self::Unit(_, span)
            | Self::Tie(_, span)
            | Self::Pin(.., span) => Some(*span),
            Self::Target(_) | Self::Part(..) | Self::Exclusive(_) | Self::Board(_) => None,
        }
    }

    /// The rule in words.
    #[must_use]
    pub fn describe(&self, design: &Design) -> String {
        let device = |index: &PartIndex| design.part_name(*index);
        match self {
            Self::Target(on) => {
                let profile = design.board(*on).and_then(Board::profile);
                let target = profile.map_or("the target", |profile| profile.name.as_str());
                format!("what the drivers of {target} can do")
            }
            Self::Part(_, part) => format!("{part} on the board"),
            Self::Reserve(_, name, _) => format!("`reserve {name}`"),
            Self::Exclusive(index) => format!("`exclusive` of {}", device(index)),
            Self::Side(index, _) => format!("the side of {}", device(index)),
            Self::Header(index, _) => format!("the header of {}", device(index)),
            Self::Unit(index, _) => format!("the unit of {}", device(index)),
            Self::Pin(index, role, _) => format!("the fixed `{role}` of {}", device(index)),
            Self::Tie(index, _) => format!("what ties the wires of {}", device(index)),
            Self::Board(index) => format!("the board of {}", device(index)),
        }
    }

    fn lift(&self, design: &mut Design) {
        match self {
            Self::Target(on) => {
                if let Some(board) = design.boards.get_mut(on.0) {
                    board.target = Target::None;
                }
            }
            Self::Part(on, part) => {
                let pins = design.boards.get_mut(on.0).map(|board| &mut board.table.pins);
                for pin in pins.into_iter().flatten() {
                    if pin.onboard.as_ref().is_some_and(|onboard| onboard.part == *part) {
                        pin.onboard = None;
                    }
                }
            }
            Self::Reserve(on, name, span) => {
                if let Some(board) = design.boards.get_mut(on.0) {
                    board.reserved.retain(|rule| rule.value != *name || rule.span != *span);
                }
            }
            Self::Exclusive(index)
            | Self::Side(index, _)
            | Self::Header(index, _)
            | Self::Unit(index, _)
            | Self::Pin(index, ..)
            | Self::Tie(index, _)
            | Self::Board(index) => self.lift_of_device(design, *index),
        }
    }

    fn lift_of_device(&self, design: &mut Design, index: PartIndex) {
        for wires in design.connections_of_mut(index) {
            match self {
                Self::Exclusive(_) => {
                    if let Some(kind) = served(&wires.kind).sharing() {
                        wires.kind = kind;
                    }
                }
                Self::Side(..) => wires.placement.side = None,
                Self::Header(..) => wires.placement.header = None,
                Self::Unit(_, span) => {
                    wires.placement.unit.take_if(|unit| unit.span == *span);
                }
                Self::Pin(.., span) => wires.placement.pins.retain(|(_, pin)| pin.span != *span),
                Self::Tie(_, span) => {
                    wires.placement.together.retain(|one| one.span != *span);
                    wires.placement.sequence.take_if(|one| *one == *span);
                }
                Self::Board(_) => wires.board = None,
                Self::Target(_) | Self::Part(..) | Self::Reserve(..) => {}
            }
        }
    }
}

/// The most rules that are tried; each costs a search. Robots have a few dozen.
const TRIED_MAX: usize = 256;

/// The rules without which the devices could be wired; empty if only the hardware stands in the
/// way, or if time ran out. Minimal if there are at most [`TRIED_MAX`]; if there are more, the rest
/// are named without having been tried.
pub(crate) fn rules(design: &Design, parts: &[PartIndex], cancel: Cancel<'_>) -> Vec<Rule> {
    let mut left = design.clone();
    left.retain_parts(|index, _| parts.contains(&index));
    let all = in_force(&left);
    let mut free = left.clone();
    all.iter().for_each(|rule| rule.lift(&mut free));
    if is_hopeless(&free, cancel) {
        return Vec::new();
    }
    let mut needed = Vec::new();
    let mut all = all.into_iter();
    for rule in all.by_ref().take(TRIED_MAX) {
        if cancel.is_over() {
            return Vec::new();
        }
        let mut without = left.clone();
        rule.lift(&mut without);
        if is_hopeless(&without, cancel) {
            left = without;
        } else {
            needed.push(rule);
        }
    }
    needed.extend(all);
    if cancel.is_over() {
        return Vec::new();
    }
    needed.into_iter().filter_map(|rule| rule.renumbered(parts)).collect()
}

impl Rule {
    /// The rule with the numbers that the parts have in the whole design.
    fn renumbered(mut self, parts: &[PartIndex]) -> Option<Self> {
        match &mut self {
            Self::Exclusive(index)
            | Self::Side(index, _)
            | Self::Header(index, _)
            | Self::Unit(index, _)
            | Self::Pin(index, ..)
            | Self::Tie(index, _)
            | Self::Board(index) => *index = *parts.get(index.0)?,
            Self::Target(_) | Self::Part(..) | Self::Reserve(..) => {}
        }
        Some(self)
    }
}

fn is_hopeless(design: &Design, cancel: Cancel<'_>) -> bool {
    let wiring = Wiring::within(design, None, cancel);
    wiring.is_impossible() || matches!(wiring.solve_only(true), Solved::Infeasible(_))
}

/// All rules of a design, in the order in which they are dropped from the blame: rules that are not
/// in the file come before those that are.
fn in_force(design: &Design) -> Vec<Rule> {
    let mut rules = Vec::new();
    for (index, board) in design.boards.iter().enumerate() {
        let index = BoardIndex(index);
        if board.profile().is_some() {
            rules.push(Rule::Target(index));
        }
        let parts = board.table.pins.iter().filter_map(|pin| pin.onboard.as_ref());
        let parts = parts.filter(|part| part.how != Occupation::Care);
        let mut parts: Vec<&str> = parts.map(|part| part.part.as_str()).collect();
        parts.sort_unstable();
        parts.dedup();
        rules.extend(parts.into_iter().map(|part| Rule::Part(index, part.to_owned())));
    }
    let parts = || (0..).map(PartIndex).zip(&design.parts);
    for (index, part) in parts() {
        if part.board.is_some() && design.boards.len() > 1 {
            rules.push(Rule::Board(index));
        }
        let mut connections = design.connections_of(index);
        if connections.any(|one| served(&one.kind).is_exclusive()) {
            rules.push(Rule::Exclusive(index));
        }
    }
    for (index, board) in design.boards.iter().enumerate() {
        let reserved = board.reserved.iter();
        let rule = |rule: &Spanned<String>| {
            Rule::Reserve(BoardIndex(index), rule.value.clone(), rule.span)
        };
        rules.extend(reserved.map(rule));
    }
    let mut reported = BTreeSet::new();
    for connection in &design.connections {
        let (index, placement) = (connection.part, &connection.placement);
        let side = placement.side.iter().map(|side| Rule::Side(index, side.span));
        let header = placement.header.iter().map(|header| Rule::Header(index, header.span));
        let unit = placement.unit.iter().map(|unit| Rule::Unit(index, unit.span));
        let pins = placement.pins.iter().map(|(role, pin)| Rule::Pin(index, *role, pin.span));
        let ties = placement.together.iter().map(|one| one.span).chain(placement.sequence);
        let ties = ties.map(|span| Rule::Tie(index, span));
        for rule in side.chain(header).chain(unit).chain(pins).chain(ties) {
            // The wires of one part share some of them.
            if rule.span().is_none_or(|span| reported.insert(span)) {
                rules.push(rule);
            }
        }
    }
    rules
}
