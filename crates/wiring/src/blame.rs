//! The rules that a conflict needs: what the file fixes or reserves, what the board has soldered
//! on, what the operating system's drivers cannot do.
//!
//! The devices of a conflict are minimal with all rules in force. Rules are then lifted one by one;
//! a rule stays lifted if the devices cannot be wired without it either. What is left is minimal
//! too: without any one of the devices, or of the rules, there is a wiring.

use std::collections::BTreeSet;

use sensedsl_board::table::Occupation;
use sensedsl_model::design::{BoardIndex, Design, PartIndex, Spanned};

use crate::Cancel;
use crate::alternatives::served;
use crate::answers::Solved;
use crate::rule::Rule;
use crate::wiring::Wiring;

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
