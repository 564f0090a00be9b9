//! Changes that could help the devices of a conflict.

use std::collections::BTreeSet;

use sensedsl_board::silicon::PinRole;
use sensedsl_board::table::Occupation;
use sensedsl_model::design::{Board, BoardIndex, Design, PartIndex, Placement, Transport};

use super::repair::Repair;
use crate::alternatives::served;
use crate::offer::roles;

/// Changes that could help the devices of a conflict.
pub(super) fn proposals(design: &Design, parts: &[PartIndex]) -> Vec<Repair> {
    let mut proposals = Vec::new();
    let mut boards: Vec<BoardIndex> = Vec::new();
    for index in parts {
        let Some(part) = design.part(*index) else { continue };
        if design.connections_of(*index).any(|one| one.placement != Placement::default()) {
            proposals.push(Repair::Free(*index));
        }
        if is_exclusive(design, *index) {
            proposals.push(Repair::Share(vec![*index]));
        }
        proposals.extend(frequencies(design, parts, *index).map(|hz| Repair::Retune(*index, hz)));
        if let Some(bound) = part.board {
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
        proposals.extend(links(board).map(|to| Repair::Relink(on, to)));
        let needed = roles(board).into_iter().filter(|(_, role)| *role != PinRole::Oscillator);
        let needed = needed.filter(|(pin, _)| board.table.pin(pin).is_some());
        proposals.extend(needed.map(|(pin, _)| Repair::Release(on, pin.to_string())));
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

/// The other frequencies at which outputs of the conflict run.
fn frequencies<'a>(
    design: &'a Design,
    parts: &'a [PartIndex],
    part: PartIndex,
) -> impl Iterator<Item = u32> {
    let hz = |part: PartIndex| {
        design.connections_of(part).find_map(|one| served(&one.kind).frequency_hz())
    };
    let own = hz(part);
    let all = parts.iter().filter_map(move |index| hz(*index));
    let others: BTreeSet<u32> = all.filter(|hz| own.is_some_and(|own| own != *hz)).collect();
    others.into_iter()
}

/// Other links that the board could have; only `none` if the file asks for the one it has.
fn links(board: &Board) -> impl Iterator<Item = Transport> {
    let has_usb = board.profile().is_some_and(|profile| profile.usb(None).is_some());
    let others = [(Transport::Usb, has_usb), (Transport::Uart, board.profile().is_some())];
    let (now, stated) = (board.link.transport, board.link.stated);
    let linked = board.profile().is_some() && now != Transport::None;
    let others = others.into_iter().filter(move |(_, can)| *can && !stated).map(|(to, _)| to);
    others.chain([Transport::None]).filter(move |to| linked && *to != now)
}

pub(super) fn is_exclusive(design: &Design, part: PartIndex) -> bool {
    let mut connections = design.connections_of(part);
    connections.any(|one| served(&one.kind).is_exclusive())
}
