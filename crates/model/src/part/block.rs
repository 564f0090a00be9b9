//! Parts as they are read, block by block: boards and parts in, the design that they are assembled into out.

use std::collections::BTreeSet;

use crate::control::Unbound;
use crate::design::{
    Board, BoardIndex, Connection, ConnectionIndex, Design, Device, DeviceIndex, Part, PartIndex,
};
use crate::spanned::Spanned;
use sensedsl_diagnostics::FileId;

/// The numbers that the next block's part, its first device and its first wires have in the design.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Next {
    pub(crate) part: PartIndex,
    pub(crate) device: DeviceIndex,
    pub(crate) connection: ConnectionIndex,
}

impl Next {
    /// The numbers of the first block.
    pub(crate) const FIRST: Self =
        Self { part: PartIndex(0), device: DeviceIndex(0), connection: ConnectionIndex(0) };

    /// The numbers after a block.
    pub(crate) fn after(self, read: &ReadPart) -> Self {
        Self {
            part: PartIndex(self.part.0 + 1),
            device: DeviceIndex(self.device.0 + read.devices.len()),
            connection: ConnectionIndex(self.connection.0 + read.connections.len()),
        }
    }
}

/// The contents of one block: a part with its devices and its wires.
#[derive(Clone, Debug)]
pub(crate) struct ReadPart {
    pub(crate) part: Part,
    pub(crate) devices: Vec<Device>,
    pub(crate) connections: Vec<Connection>,
    /// What the part is besides, if it is code.
    pub(crate) controller: Option<Unbound>,
}

/// Assembles boards and parts: those that could be read, and the parts that are certain to be on
/// them. Also returns the names of those left out, and the controllers with the numbers of their parts.
///
/// If a board is missing, a part that may go to any board may belong on that one.
pub(crate) fn assemble(
    file: FileId,
    boards: Vec<Option<Board>>,
    names: &[Option<Spanned<String>>],
    parts: Vec<ReadPart>,
) -> (Design, Vec<Spanned<String>>, Vec<(PartIndex, Unbound)>) {
    let mut next = 0;
    let places: Vec<Option<BoardIndex>> = boards
        .iter()
        .map(|board| {
            let place = BoardIndex(next);
            next += usize::from(board.is_some());
            board.is_some().then_some(place)
        })
        .collect();
    let is_whole = next == places.len();
    let unread = boards.iter().zip(names).filter(|(board, _)| board.is_none());
    let mut left_out: Vec<Spanned<String>> = unread.filter_map(|(_, name)| name.clone()).collect();
    let boards = boards.into_iter().flatten().collect();
    let mut design = Design {
        file,
        boards,
        parts: Vec::new(),
        devices: Vec::new(),
        connections: Vec::new(),
        controllers: Vec::new(),
        tests: Vec::new(),
    };
    let mut controllers = Vec::new();
    let mut homeless: BTreeSet<PartIndex> = BTreeSet::new();
    for mut read in parts {
        let place =
            read.part.board.and_then(|BoardIndex(index)| places.get(index).copied().flatten());
        match (read.part.board, place) {
            (None, _) if is_whole => {}
            (Some(_), Some(place)) => {
                read.part.board = Some(place);
                read.connections.iter_mut().for_each(|one| one.board = Some(place));
            }
            (None | Some(_), _) => {
                homeless.insert(PartIndex(design.parts.len()));
                left_out.push(read.part.name.clone());
            }
        }
        controllers.extend(read.controller.map(|one| (PartIndex(design.parts.len()), one)));
        design.parts.push(read.part);
        design.devices.extend(read.devices);
        design.connections.extend(read.connections);
    }
    if !homeless.is_empty() {
        let kept = design.retain_parts(|index, _| !homeless.contains(&index));
        controllers.retain_mut(|(part, _)| {
            let new = kept.binary_search(part).ok().map(PartIndex);
            new.map(|new| *part = new).is_some()
        });
    }
    (design, left_out, controllers)
}
