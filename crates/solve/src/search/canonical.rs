//! Symmetric answers: equal boards and interchangeable devices change places.
//!
//! From an answer, makes one that is equally good and comes no later in the order of the tie-break,
//! without any search. This is a step towards the canonical one of all its symmetric images.

use super::tie_break::{Entry, entries};
use crate::index::{AltId, CandId, IdVec};
use crate::model::bundles::Bundle;
use crate::model::{Choices, Chosen, Model};
use crate::problem::{BoardId, DeviceId, PinId};

/// Puts interchangeable devices in order, and moves what is on equal boards to the first of them.
pub(crate) fn earliest(model: &Model, known: Choices) -> Choices {
    let entries = entries(model);
    let mut best = earlier(model, &entries, in_order(model, &known), known);
    let mut used = IdVec::same(false, model.spare.len());
    let equal = &model.boards.first_equal;
    for device in model.devices {
        let board = model.alt_board[best[device].alt];
        let free = |b: &BoardId| *b < board && !used[*b] && equal[*b] == equal[board];
        if let Some(first) = used.ids().iter().find(free)
            && let Some(swapped) = swapped(model, &best, first, board)
        {
            best = earlier(model, &entries, swapped, best);
        }
        used[model.alt_board[best[device].alt]] = true;
    }
    earlier(model, &entries, in_order(model, &best), best)
}

/// Puts interchangeable devices in order, then bundles.
fn in_order(model: &Model, known: &Choices) -> Choices {
    bundles_in_order(model, &devices_in_order(model, known))
}

/// The earlier of two answers.
fn earlier(model: &Model, entries: &[Entry], one: Choices, other: Choices) -> Choices {
    let values = |choices| entries.iter().map(move |entry| entry.of(model, choices));
    if values(&one).lt(values(&other)) { one } else { other }
}

/// Swaps what is on two boards.
fn swapped(model: &Model, known: &Choices, one: BoardId, other: BoardId) -> Option<Choices> {
    let swapped = known.iter().map(|chosen| {
        let board = match model.alt_board[chosen.alt] {
            board if board == one => other,
            board if board == other => one,
            _ => return Some(chosen.clone()),
        };
        Some(moved(model, chosen, model.boards.alt_on(model, chosen.alt, board)?))
    });
    swapped.collect()
}

/// Gives interchangeable devices their choices in order.
fn devices_in_order(model: &Model, known: &Choices) -> Choices {
    let mut sorted = known.clone();
    for leader in model.class_leaders() {
        let has = |device: DeviceId| {
            let Chosen { alt, cands } = &known[device];
            let pins: Vec<PinId> = cands.iter().map(|&id| model.cand[id].pin).collect();
            (pins, model.alt_position(*alt), device)
        };
        let mut had: Vec<_> = model.class_of(leader).map(has).collect();
        had.sort_unstable();
        for (device, (_, _, from)) in model.class_of(leader).zip(&had) {
            let chosen = &known[*from];
            sorted[device] = moved(model, chosen, model.twin_alt(chosen.alt, device));
        }
    }
    sorted
}

/// Gives interchangeable bundles their choices in order.
fn bundles_in_order(model: &Model, known: &Choices) -> Choices {
    let mut sorted = known.clone();
    for family in &model.bundles.families {
        let has = |bundle: &Bundle| -> Vec<(Vec<PinId>, usize, DeviceId)> {
            let of_device = |&device: &DeviceId| {
                let Chosen { alt, cands } = &known[device];
                let pins = cands.iter().map(|&id| model.cand[id].pin).collect();
                (pins, model.alt_position(*alt), device)
            };
            bundle.devices.iter().map(of_device).collect()
        };
        let mut had: Vec<_> = family.iter().map(has).collect();
        had.sort_unstable();
        for (bundle, had) in family.iter().zip(&had) {
            for (device, (_, _, from)) in bundle.devices.iter().zip(had) {
                let chosen = &known[*from];
                sorted[*device] = moved(model, chosen, model.twin_alt(chosen.alt, *device));
            }
        }
    }
    sorted
}

/// The same candidates of another alternative with the same choices.
fn moved(model: &Model, chosen: &Chosen, alt: AltId) -> Chosen {
    let twin = |&id: &CandId| model.twin_cand(id, alt);
    Chosen { alt, cands: chosen.cands.iter().map(twin).collect() }
}
