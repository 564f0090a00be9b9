//! A rule that a conflict may need, and the design without it.
//!
//! In: a design. Out: the rule in words, its place in the file, or the design with the rule lifted.
//! Which rules a conflict does need is found in `blame.rs`.

use sensedsl_board::profile::Target;
use sensedsl_diagnostics::Span;
use sensedsl_model::design::{Board, BoardIndex, Design, PartIndex};
use sensedsl_model::kind::Role;

use crate::alternatives::served;

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

    pub(crate) fn lift(&self, design: &mut Design) {
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

    /// The rule with the numbers that the parts have in the whole design.
    pub(crate) fn renumbered(mut self, parts: &[PartIndex]) -> Option<Self> {
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
