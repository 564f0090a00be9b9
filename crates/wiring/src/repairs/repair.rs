//! A change to a design: its name, and the design after it.

use sensedsl_board::pin::PinName;
use sensedsl_board::silicon::PinRole;
use sensedsl_board::table::release_name;
use sensedsl_model::design::{BoardIndex, Design, Link, PartIndex, Placement, Spanned, Transport};

use crate::alternatives::served;
use crate::names::list;
use crate::offer::roles;

/// A change after which there is a wiring.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Repair {
    /// Remove whatever the file fixes in the device's wiring.
    Free(PartIndex),
    /// Let the devices share a bus.
    Share(Vec<PartIndex>),
    /// Run an output at the frequency of others, so that they can be on one timer.
    Retune(PartIndex, u32),
    /// Let the device go to another board of the file.
    Move(PartIndex, BoardIndex),
    /// Do without a `reserve`.
    Unreserve(BoardIndex, String),
    /// Do without an on-board part.
    Release(BoardIndex, String),
    /// Let the board talk to its host in another way, or not at all.
    Relink(BoardIndex, Transport),
    /// Leave the device out.
    Drop(PartIndex),
}

/// A repair that gives a wiring.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Repaired {
    /// The change.
    pub repair: Repair,
    /// The opportunity cost of that wiring.
    pub cost: u32,
    /// Whether that is known to be the least possible after the change.
    pub is_best: bool,
}

impl Repair {
    /// The word in the JSON output.
    #[must_use]
    pub const fn action(&self) -> &'static str {
        match self {
            Self::Free(_) => "free",
            Self::Share(_) => "share",
            Self::Retune(..) => "retune",
            Self::Move(..) => "move",
            Self::Unreserve(..) => "unreserve",
            Self::Release(..) => "release",
            Self::Relink(..) => "link",
            Self::Drop(_) => "drop",
        }
    }

    /// The device that is changed, if it is a single one.
    #[must_use]
    pub const fn device(&self) -> Option<PartIndex> {
        match self {
            Self::Free(device)
            | Self::Retune(device, _)
            | Self::Move(device, _)
            | Self::Drop(device) => Some(*device),
            Self::Share(devices) => match devices.as_slice() {
                [device] => Some(*device),
                _ => None,
            },
            Self::Unreserve(..) | Self::Release(..) | Self::Relink(..) => None,
        }
    }

    /// The repair as an instruction.
    #[must_use]
    pub fn describe(&self, design: &Design) -> String {
        let device = |index: &PartIndex| design.part_name(*index);
        let board =
            |index: &BoardIndex| design.board(*index).map_or("", |board| board.name.value.as_str());
        match self {
            Self::Free(index) => format!("remove the fixed pins or place of {}", device(index)),
            Self::Share(devices) => {
                let names: Vec<&str> = devices.iter().map(device).collect();
                let bus = if names.len() == 1 { "its bus" } else { "a bus" };
                format!("let {} share {bus}", list(&names, "and"))
            }
            Self::Retune(index, hz) => format!("run {} at {hz} Hz", device(index)),
            Self::Move(index, to) => format!("move {} to {}", device(index), board(to)),
            Self::Unreserve(on, name) if design.boards.len() > 1 => {
                format!("do not reserve {name} of {}", board(on))
            }
            Self::Unreserve(_, name) => format!("do not reserve {name}"),
            Self::Release(on, part) => match needed(design, *on, part) {
                Some(role) => format!("release {part}, a pin of {}", role.describe()),
                None => format!("release {}", release_name(part)),
            },
            Self::Relink(on, to) => {
                let to = to.name();
                let unasked = design.board(*on).is_some_and(|board| !board.link.stated);
                let why = if unasked { ": nothing in the file asks for the link" } else { "" };
                format!("write `link {{ transport = {to}; }}` in {}{why}", board(on))
            }
            Self::Drop(index) => format!("leave out {}", device(index)),
        }
    }

    /// Whether it changes only devices, and no board.
    pub(super) const fn is_of_devices(&self) -> bool {
        match self {
            Self::Free(_) | Self::Share(_) | Self::Retune(..) | Self::Move(..) | Self::Drop(_) => {
                true
            }
            Self::Unreserve(..) | Self::Release(..) | Self::Relink(..) => false,
        }
    }

    /// The same change in a design that has only `parts`, which are in order.
    pub(super) fn renumbered(&self, parts: &[PartIndex]) -> Self {
        let new = |old: &PartIndex| PartIndex(parts.partition_point(|part| part < old));
        match self {
            Self::Free(part) => Self::Free(new(part)),
            Self::Share(all) => Self::Share(all.iter().map(new).collect()),
            Self::Retune(part, hz) => Self::Retune(new(part), *hz),
            Self::Move(part, to) => Self::Move(new(part), *to),
            Self::Drop(part) => Self::Drop(new(part)),
            Self::Unreserve(..) | Self::Release(..) | Self::Relink(..) => self.clone(),
        }
    }

    /// The design after the change.
    pub(super) fn applied(&self, design: &Design) -> Design {
        let mut design = design.clone();
        match self {
            Self::Free(index) => {
                for wires in design.connections_of_mut(*index) {
                    wires.placement = Placement::default();
                }
            }
            Self::Share(devices) => {
                for wires in &mut design.connections {
                    if devices.contains(&wires.part)
                        && let Some(kind) = served(&wires.kind).sharing()
                    {
                        wires.kind = kind;
                    }
                }
            }
            Self::Retune(index, hz) => {
                for wires in design.connections_of_mut(*index) {
                    if let Some(kind) = served(&wires.kind).retuned(*hz) {
                        wires.kind = kind;
                    }
                }
            }
            Self::Move(index, to) => {
                for wires in design.connections_of_mut(*index) {
                    wires.board = Some(*to);
                }
            }
            Self::Unreserve(on, name) => {
                if let Some(board) = design.boards.get_mut(on.0) {
                    board.reserved.retain(|rule| rule.value != *name);
                }
            }
            Self::Release(on, part) => {
                if let Some(board) = design.boards.get_mut(on.0) {
                    let span = board.name.span;
                    board.released.push(Spanned { value: release_name(part).to_uppercase(), span });
                }
            }
            Self::Relink(on, to) => {
                if let Some(board) = design.boards.get_mut(on.0) {
                    board.link = Link { transport: *to, unit: None, ..board.link.clone() };
                    board.link.pins.clear();
                }
            }
            Self::Drop(index) => {
                design.retain_parts(|part, _| part != *index);
            }
        }
        design
    }
}

/// The purpose for which the MCU needs the pin of this name.
fn needed(design: &Design, on: BoardIndex, pin: &str) -> Option<PinRole> {
    let pin = PinName::parse(pin)?;
    roles(design.board(on)?).get(&pin).copied()
}
