//! Parts as they are read, block by block, before they are assembled into a design.

use crate::design::{
    Board, BoardIndex, Connection, ConnectionIndex, Design, Device, DeviceIndex, Part, PartIndex,
    Spanned,
};
use sensedsl_diagnostics::FileId;

/// The contents of one block: a part with its devices and its wires. Indices count from 0 within
/// it.
#[derive(Clone, Debug)]
pub(crate) struct ReadPart {
    pub(crate) part: Part,
    pub(crate) devices: Vec<Device>,
    pub(crate) connections: Vec<Connection>,
}

/// Assembles boards and parts.
pub(crate) fn assemble(file: FileId, boards: Vec<Board>, read: Vec<ReadPart>) -> Design {
    let mut design =
        Design { file, boards, parts: Vec::new(), devices: Vec::new(), connections: Vec::new() };
    for ReadPart { part, devices, connections } in read {
        let index = PartIndex(design.parts.len());
        let (first, first_device) = (design.connections.len(), design.devices.len());
        design.parts.push(part);
        design.devices.extend(devices.into_iter().map(|mut device| {
            device.part = index;
            for ConnectionIndex(number) in &mut device.connections {
                *number += first;
            }
            device
        }));
        let connections = connections.into_iter().map(|one| {
            let device = DeviceIndex(first_device + one.device.0);
            Connection { part: index, device, ..one }
        });
        design.connections.extend(connections);
    }
    design
}

/// The boards that could be read and the parts that are certain to be on them, and the names of
/// those left out.
///
/// If a board is missing, a part that may go to any board may belong on that one.
pub(crate) fn on_known_boards(
    boards: Vec<Option<Board>>,
    names: &[Option<Spanned<String>>],
    parts: Vec<ReadPart>,
) -> (Vec<Board>, Vec<ReadPart>, Vec<Spanned<String>>) {
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
    let mut sound = Vec::new();
    for mut read in parts {
        match read.part.board {
            None if is_whole => sound.push(read),
            Some(BoardIndex(index)) if let Some(Some(place)) = places.get(index) => {
                read.part.board = Some(*place);
                read.connections.iter_mut().for_each(|one| one.board = Some(*place));
                sound.push(read);
            }
            None | Some(_) => left_out.push(read.part.name),
        }
    }
    (boards.into_iter().flatten().collect(), sound, left_out)
}
