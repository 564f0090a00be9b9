//! What would help where there is no wiring: changes that were each tried by solving.

use sensedsl_board::table::Occupation;
use sensedsl_model::design::{BoardIndex, Design, DeviceIndex, Placement, Spanned};
use sensedsl_model::kind::Kind;

use crate::{Solved, Wiring};

/// A change after which there is a wiring.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Repair {
    /// Remove what the file fixes of the device's wiring.
    Free(DeviceIndex),
    /// Let the device share its bus.
    Share(DeviceIndex),
    /// Let the device go to another board of the file.
    Move(DeviceIndex, BoardIndex),
    /// Do without a `reserve`.
    Unreserve(BoardIndex, String),
    /// Do without an on-board part.
    Release(BoardIndex, String),
    /// Leave the device out.
    Drop(DeviceIndex),
}

/// A repair and the opportunity cost of the best wiring after it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Repaired {
    /// The change.
    pub repair: Repair,
    /// What the best wiring costs then.
    pub cost: u32,
}

impl Repair {
    /// The word of the JSON output.
    #[must_use]
    pub const fn action(&self) -> &'static str {
        match self {
            Self::Free(_) => "free",
            Self::Share(_) => "share",
            Self::Move(..) => "move",
            Self::Unreserve(..) => "unreserve",
            Self::Release(..) => "release",
            Self::Drop(_) => "drop",
        }
    }

    /// The device that is changed.
    #[must_use]
    pub const fn device(&self) -> Option<DeviceIndex> {
        match self {
            Self::Free(device)
            | Self::Share(device)
            | Self::Move(device, _)
            | Self::Drop(device) => Some(*device),
            Self::Unreserve(..) | Self::Release(..) => None,
        }
    }

    /// The repair as an instruction.
    #[must_use]
    pub fn describe(&self, design: &Design) -> String {
        let device = |index: &DeviceIndex| {
            design.device(*index).map_or("", |device| device.name.value.as_str())
        };
        let board =
            |index: &BoardIndex| design.board(*index).map_or("", |board| board.name.value.as_str());
        match self {
            Self::Free(index) => format!("remove the fixed pins or place of {}", device(index)),
            Self::Share(index) => format!("let {} share its bus", device(index)),
            Self::Move(index, to) => format!("move {} to {}", device(index), board(to)),
            Self::Unreserve(_, name) => format!("do not reserve {name}"),
            Self::Release(_, part) => format!("release {part}"),
            Self::Drop(index) => format!("leave out {}", device(index)),
        }
    }

    /// The design after the change.
    fn applied(&self, design: &Design) -> Design {
        let mut design = design.clone();
        match self {
            Self::Free(index) => {
                if let Some(device) = design.devices.get_mut(index.0) {
                    device.placement = Placement::default();
                }
            }
            Self::Share(index) => {
                if let Some(device) = design.devices.get_mut(index.0)
                    && let Kind::I2c(i2c) = &mut device.kind
                {
                    i2c.exclusive = false;
                }
            }
            Self::Move(index, to) => {
                if let Some(device) = design.devices.get_mut(index.0) {
                    device.board = Some(*to);
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
                    board.released.push(Spanned { value: part.to_uppercase(), span });
                }
            }
            Self::Drop(index) => {
                if index.0 < design.devices.len() {
                    design.devices.remove(index.0);
                }
            }
        }
        design
    }
}

/// The repairs that work, the gentlest first: freeing what was fixed, then moving, then doing
/// without something, then leaving a device out; within each the cheapest wiring first.
pub(crate) fn find(design: &Design, devices: &[DeviceIndex]) -> Vec<Repaired> {
    let mut found: Vec<(usize, Repaired)> = Vec::new();
    for repair in proposals(design, devices) {
        let changed = repair.applied(design);
        if let Solved::Wired(wiring) = Wiring::new(&changed, None).solve_only(false) {
            found.push((rank(&repair), Repaired { repair, cost: wiring.cost }));
        }
    }
    found.sort_by_key(|(rank, repaired)| (*rank, repaired.cost));
    found.into_iter().map(|(_, repaired)| repaired).collect()
}

const fn rank(repair: &Repair) -> usize {
    match repair {
        Repair::Free(_) => 0,
        Repair::Share(_) => 1,
        Repair::Move(..) => 2,
        Repair::Unreserve(..) => 3,
        Repair::Release(..) => 4,
        Repair::Drop(_) => 5,
    }
}

/// Changes that could help the devices of a conflict.
fn proposals(design: &Design, devices: &[DeviceIndex]) -> Vec<Repair> {
    let mut proposals = Vec::new();
    let mut boards: Vec<BoardIndex> = Vec::new();
    for index in devices {
        let Some(device) = design.device(*index) else { continue };
        if device.placement != Placement::default() {
            proposals.push(Repair::Free(*index));
        }
        if matches!(&device.kind, Kind::I2c(i2c) if i2c.exclusive) {
            proposals.push(Repair::Share(*index));
        }
        if let Some(bound) = device.board {
            boards.push(bound);
            let others = (0..design.boards.len()).map(BoardIndex).filter(|to| *to != bound);
            proposals.extend(others.map(|to| Repair::Move(*index, to)));
        } else {
            boards.extend((0..design.boards.len()).map(BoardIndex));
        }
        proposals.push(Repair::Drop(*index));
    }
    boards.sort_unstable();
    boards.dedup();
    for on in boards {
        let Some(board) = design.board(on) else { continue };
        let names = board.reserved.iter().map(|rule| rule.value.clone());
        proposals.extend(names.map(|name| Repair::Unreserve(on, name)));
        let mut parts: Vec<String> = board
            .table
            .pins
            .iter()
            .filter_map(|pin| pin.onboard.as_ref())
            .filter(|part| part.how == Occupation::Taken)
            .map(|part| part.part.clone())
            .collect();
        parts.sort();
        parts.dedup();
        proposals.extend(parts.into_iter().map(|part| Repair::Release(on, part)));
    }
    proposals
}
