//! Answers that follow from an answer: boards and devices that are alike change places.
//!
//! An answer in, one that is as good and comes no later in the order of the tie-break out, without
//! any search.
#![expect(clippy::indexing_slicing, reason = "all ids come from the model")]

use crate::model::Model;
use crate::search::Choices;
use crate::search::tie_break::{Entry, entries};

/// Puts alike devices in order, and what is on equal boards on the first of them.
pub(crate) fn earliest(model: &Model, known: Choices) -> Choices {
    let entries = entries(model);
    let mut best = earlier(model, &entries, devices_in_order(model, &known), known);
    let mut used = vec![false; model.spare.len()];
    let equal = &model.boards.first_equal;
    for device in 0..model.devices {
        let board = model.alt_board[best[device].0];
        let free = |b: &usize| !used[*b] && equal[*b] == equal[board];
        if let Some(first) = (0..board).find(free)
            && let Some(swapped) = swapped(model, &best, first, board)
        {
            best = earlier(model, &entries, swapped, best);
        }
        used[model.alt_board[best[device].0]] = true;
    }
    earlier(model, &entries, devices_in_order(model, &best), best)
}

/// The one that comes first.
fn earlier(model: &Model, entries: &[Entry], one: Choices, other: Choices) -> Choices {
    let values = |choices| entries.iter().map(move |entry| entry.of(model, choices));
    if values(&one).lt(values(&other)) { one } else { other }
}

/// What is on the one board goes to the other.
fn swapped(model: &Model, known: &Choices, one: usize, other: usize) -> Option<Choices> {
    let swapped = known.iter().map(|(alt, cands)| {
        let board = match model.alt_board[*alt] {
            board if board == one => other,
            board if board == other => one,
            _ => return Some((*alt, cands.clone())),
        };
        let twin = model.boards.alt_on(model, *alt, board)?;
        Some((twin, moved(model, cands, *alt, twin)))
    });
    swapped.collect()
}

/// Alike devices in the order of what they have.
fn devices_in_order(model: &Model, known: &Choices) -> Choices {
    let mut sorted = known.clone();
    for class in (0..model.devices).filter(|&d| model.class[d] == d) {
        let alike = |d: &usize| model.class[*d] == class;
        let devices: Vec<usize> = (class..model.devices).filter(alike).collect();
        let has = |&device: &usize| {
            let (alt, cands) = &known[device];
            let pins: Vec<usize> = cands.iter().map(|&id| model.cand(id).pin).collect();
            (pins, alt - model.alts.range(device).start, device)
        };
        let mut had: Vec<_> = devices.iter().map(has).collect();
        had.sort_unstable();
        for (&device, (_, offset, from)) in devices.iter().zip(&had) {
            let (alt, cands) = &known[*from];
            let twin = model.alts.range(device).start + offset;
            sorted[device] = (twin, moved(model, cands, *alt, twin));
        }
    }
    sorted
}

/// The same candidates of another alternative with the same choices.
fn moved(model: &Model, cands: &[usize], from: usize, to: usize) -> Vec<usize> {
    let roles = model.roles.range(from).zip(model.roles.range(to));
    let place = |(&id, (from, to)): (&usize, (usize, usize))| {
        id - model.cands.range(from).start + model.cands.range(to).start
    };
    cands.iter().zip(roles).map(place).collect()
}
