//! Wishes for things that no board has.

use std::collections::BTreeSet;

use sensedsl_board::table::Pin;
use sensedsl_diagnostics::codes::w0604_unused_rule;
use sensedsl_diagnostics::{Diagnostic, nearest};
use sensedsl_model::design::{Board, BoardIndex, Design, Preference, PreferenceSubject};

/// Wishes for a pin, unit, side or header that is on none of the boards that they are for.
pub(super) fn nowhere(design: &Design) -> Vec<Diagnostic> {
    let boards: Vec<(BoardIndex, &Board)> =
        design.boards.iter().enumerate().map(|(at, board)| (BoardIndex(at), board)).collect();
    let mut found = Vec::new();
    for of_board in &boards {
        let on = std::slice::from_ref(of_board);
        found.extend(of_board.1.wishes.iter().filter_map(|wish| useless(wish, on)));
    }
    // The connections of a part share their rules.
    let mut reported = BTreeSet::new();
    for wires in &design.connections {
        if reported.insert(wires.part) {
            let may_be_on = |(index, _): &&(BoardIndex, &Board)| {
                wires.board.is_none_or(|board| board == *index)
            };
            let on: Vec<_> = boards.iter().filter(may_be_on).copied().collect();
            found.extend(wires.wishes.iter().filter_map(|wish| useless(wish, &on)));
        }
    }
    found
}

fn useless(wish: &Preference, boards: &[(BoardIndex, &Board)]) -> Option<Diagnostic> {
    let pins = || boards.iter().flat_map(|(_, board)| &board.table.pins);
    let (name, known): (&str, BTreeSet<&str>) = match &wish.what {
        PreferenceSubject::Pin(_, pin)
            if boards.iter().any(|(index, _)| pin.on(*index).is_some()) =>
        {
            return None;
        }
        PreferenceSubject::Pin(_, pin) => {
            (&pin.spelled, pins().map(|pin| pin.name.as_str()).collect())
        }
        PreferenceSubject::Unit(unit) => return no_unit(wish, unit, boards),
        PreferenceSubject::Side(side) => (side, pins().flat_map(Pin::sides).collect()),
        PreferenceSubject::Header(name) => (name, pins().flat_map(Pin::headers).collect()),
        PreferenceSubject::Together(_) | PreferenceSubject::Sequence => return None,
    };
    let exists = known.iter().any(|one| one.eq_ignore_ascii_case(name));
    (!exists).then(|| report(wish, name, nearest(name, known.iter().copied())))
}

fn no_unit(wish: &Preference, unit: &str, boards: &[(BoardIndex, &Board)]) -> Option<Diagnostic> {
    let mut known = BTreeSet::new();
    for (_, board) in boards {
        let usages = board.table.pins.iter().flat_map(|pin| &pin.usages);
        for one in usages.flat_map(|usage| usage.signal.function().units()) {
            if board.same_unit(unit, one.as_str()) {
                return None;
            }
            known.insert(one.as_str().to_owned());
        }
    }
    Some(report(wish, unit, nearest(unit, known.iter().map(String::as_str))))
}

fn report(wish: &Preference, name: &str, meant: Option<&str>) -> Diagnostic {
    let why = format!("no board that it is for has `{name}`");
    let rule = crate::labels::describe(wish);
    let unused = w0604_unused_rule::unused_rule(wish.span, &rule, &why);
    match meant {
        Some(meant) => unused.help(format!("did you mean `{meant}`? Otherwise remove the line")),
        None => unused,
    }
}
