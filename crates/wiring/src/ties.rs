//! Ties between the connections of one part: a chip is on one board, the elements of an array may
//! be wanted on one unit, one header, one side, or one after the other along a header.
//!
//! All ties are expressed by claims. A resource stands for what must be the same, and each
//! connection claims it as one of the group that chose the same. An order is a claim on each place
//! of the header: an element claims all places up to its own as one of those before, the next
//! element claims all from its own on as one of those behind, so that no place is claimed by both.
//!
//! The header or side is claimed by a whole alternative: claims keep devices apart, not the wires
//! of one, and the solver decides what many devices choose in common before it looks at single
//! pins.
//!
//! A wish doubles the alternatives: those that keep it, and loose ones that violate it. The loose
//! ones make a claim as loose ones, so all elements of an array are one or the other.

mod common_unit;
mod room;

use std::collections::{BTreeMap, BTreeSet};

use sensedsl_board::pin::natural;
use sensedsl_board::table::{Pin, Usage};
use sensedsl_model::design::{
    Board, BoardIndex, Connection, Design, PartIndex, PreferenceSubject, Together,
};
use sensedsl_solve::problem::{self as solver, Alternative, Claim, RuleId};

use crate::builder::{Builder, Chosen, Meaning};
use crate::converters::units_of;
use crate::names::{Group, Resource, Tied};
use crate::wishes;

/// A property that all connections of a part share, or their order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Tie {
    Together(Together),
    Sequence,
}

/// The connections of one part as the solver gets them.
pub(crate) struct Elements<'e> {
    pub(crate) devices: &'e mut [solver::Device],
    pub(crate) meanings: &'e mut [Vec<Meaning>],
}

/// Ties the connections of a part. Unless `wished`, only hard ties are made.
pub(crate) fn tie(
    builder: &mut Builder<'_>,
    part: PartIndex,
    elements: &mut Elements<'_>,
    wished: bool,
) {
    let design = builder.design;
    let connections: Vec<&Connection> = design.connections_of(part).collect();
    let Some(first) = connections.first() else { return };
    if first.board.is_none() && design.boards.len() > 1 && connections.len() > 1 {
        on_one_board(builder, part, elements);
    }
    if first.element.is_none() {
        if connections.len() > 1 {
            wishes::leave_out_others(builder, part, elements.devices, elements.meanings);
        }
        return;
    }
    let together = first.placement.together.iter().map(|one| Tie::Together(one.value));
    for hard in together.chain(first.placement.sequence.map(|_| Tie::Sequence)) {
        let tier = Tier::new(design, part, hard, None, &connections, elements);
        tier.hard(builder, elements);
    }
    for (rule, board, wish) in builder.rules_of(part) {
        let soft = match &wish.what {
            PreferenceSubject::Together(what) => Tie::Together(*what),
            PreferenceSubject::Sequence => Tie::Sequence,
            PreferenceSubject::Pin(..)
            | PreferenceSubject::Unit(_)
            | PreferenceSubject::Side(_)
            | PreferenceSubject::Header(_) => continue,
        };
        if wished {
            let tier = Tier::new(design, part, soft, Some(rule), &connections, elements);
            tier.soft(builder, elements, board);
        }
    }
}

fn on_one_board(builder: &mut Builder<'_>, part: PartIndex, elements: &mut Elements<'_>) {
    for (device, meanings) in elements.devices.iter_mut().zip(elements.meanings.iter()) {
        for (alternative, meaning) in device.alternatives.iter_mut().zip(meanings) {
            let group = Group::Tie(meaning.board, "the board".to_owned());
            alternative.claims.push(builder.names.shared(Resource::Part(part), group));
        }
    }
}

/// Units by their names.
type Units = BTreeSet<String>;

/// The alternatives that an alternative becomes.
type Tight = Vec<(Alternative, Meaning)>;

/// Makes the claims of one tie.
struct Tier<'d> {
    design: &'d Design,
    part: PartIndex,
    tie: Tie,
    rule: Option<RuleId>,
    connections: Vec<&'d Connection>,
    /// All sets of units that the candidates have.
    sets: BTreeMap<BoardIndex, BTreeSet<Units>>,
    /// The places of each header that the candidates have, in order.
    places: BTreeMap<(BoardIndex, String), Vec<String>>,
}

impl<'d> Tier<'d> {
    fn new(
        design: &'d Design,
        part: PartIndex,
        tie: Tie,
        rule: Option<RuleId>,
        connections: &[&'d Connection],
        elements: &Elements<'_>,
    ) -> Self {
        let (sets, places) = (BTreeMap::new(), BTreeMap::new());
        let connections = connections.to_vec();
        let mut tier = Self { design, part, tie, rule, connections, sets, places };
        for meaning in elements.meanings.iter().flatten() {
            let Some(board) = design.board(meaning.board) else { continue };
            for chosen in meaning.roles.iter().flatten() {
                if let Some(set) = tier.set(board, chosen) {
                    tier.sets.entry(meaning.board).or_default().insert(set);
                }
                let Some(pin) = board.table.pins.get(chosen.pin) else { continue };
                for header in pin.headers() {
                    let Some(position) = pin.position_at(header) else { continue };
                    let key = (meaning.board, header.to_ascii_uppercase());
                    tier.places.entry(key).or_default().push(position.to_owned());
                }
            }
        }
        for positions in tier.places.values_mut() {
            positions.sort_by(|a, b| natural(a, b));
            positions.dedup();
        }
        tier
    }

    /// Offers only what keeps the tie.
    fn hard(&self, builder: &mut Builder<'_>, elements: &mut Elements<'_>) {
        let each = elements.devices.iter_mut().zip(elements.meanings.iter_mut());
        for ((device, meanings), number) in each.zip(0..) {
            let alternatives = std::mem::take(&mut device.alternatives);
            let all = alternatives.into_iter().zip(std::mem::take(meanings));
            for (alternative, meaning) in all {
                if builder.cancel.is_over() {
                    break;
                }
                for (tight, meaning) in self.tight(builder, number, alternative, meaning) {
                    device.alternatives.push(tight);
                    meanings.push(meaning);
                }
            }
        }
    }

    /// Offers what keeps the tie, and what violates the rule as a whole.
    fn soft(
        &self,
        builder: &mut Builder<'_>,
        elements: &mut Elements<'_>,
        only: Option<BoardIndex>,
    ) {
        let room = self.boards_with_room(elements);
        let each = elements.devices.iter_mut().zip(elements.meanings.iter_mut());
        for ((device, meanings), number) in each.zip(0..) {
            let alternatives = std::mem::take(&mut device.alternatives);
            let all = alternatives.into_iter().zip(std::mem::take(meanings));
            let (mut tight, mut loose) = (Vec::new(), Vec::new());
            for (alternative, meaning) in all {
                if builder.cancel.is_over() {
                    break;
                }
                if only.is_some_and(|board| board != meaning.board) {
                    tight.push((alternative, meaning));
                    continue;
                }
                let kept = self.tight(builder, number, alternative.clone(), meaning.clone());
                tight.extend(kept.into_iter().filter(|_| room.contains(&meaning.board)));
                loose.push((self.loose(builder, alternative, meaning.board), meaning));
            }
            tight.append(&mut loose);
            (device.alternatives, *meanings) = tight.into_iter().unzip();
        }
    }

    fn loose(
        &self,
        builder: &mut Builder<'_>,
        mut alternative: Alternative,
        board: BoardIndex,
    ) -> Alternative {
        let resource = self.resource(Tied::Kept);
        let group = Group::Tie(board, "loose".to_owned());
        alternative.claims.push(builder.names.shared(resource, group));
        alternative.violates.extend(self.rule);
        alternative
    }

    /// The alternative with the claims of the tie, without the candidates that cannot keep it;
    /// empty if a role has none left, several if it can be kept in several ways.
    fn tight(
        &self,
        builder: &mut Builder<'_>,
        number: u16,
        mut alternative: Alternative,
        meaning: Meaning,
    ) -> Tight {
        let Some(board) = self.design.board(meaning.board) else { return Vec::new() };
        if self.rule.is_some() {
            let resource = self.resource(Tied::Kept);
            let group = Group::Tie(meaning.board, "tied".to_owned());
            alternative.claims.push(builder.names.shared(resource, group));
        }
        match (self.tie, &meaning.unit) {
            (Tie::Together(Together::Unit), Some(unit)) => {
                let resource = self.resource(Tied::Same(Together::Unit));
                let group = Group::Tie(meaning.board, unit.clone());
                alternative.claims.push(builder.names.shared(resource, group));
                vec![(alternative, meaning)]
            }
            (Tie::Together(Together::Unit), None) if !self.is_told_by_pairs(meaning.board) => {
                self.by_common_unit(builder, number, board, (alternative, meaning))
            }
            (Tie::Together(Together::Unit), None) => {
                let at = meaning.board;
                let units = |chosen: &Chosen| Some(self.units(builder, at, board, chosen));
                only(alternative, meaning, units).into_iter().collect()
            }
            (Tie::Together(Together::Side), _) => {
                self.by_place(builder, (number, Together::Side), board, (alternative, meaning))
            }
            (Tie::Together(Together::Header) | Tie::Sequence, _) => {
                self.by_place(builder, (number, Together::Header), board, (alternative, meaning))
            }
        }
    }

    /// The alternative for each header or side that all its wires can be at.
    fn by_place(
        &self,
        builder: &mut Builder<'_>,
        (number, what): (u16, Together),
        board: &Board,
        (alternative, meaning): (Alternative, Meaning),
    ) -> Tight {
        let named = |at: &Chosen| -> Vec<String> {
            let Some(pin) = board.table.pins.get(at.pin) else { return Vec::new() };
            let names = if what == Together::Side { pin.sides() } else { pin.headers() };
            names.into_iter().map(str::to_ascii_uppercase).collect()
        };
        let names: BTreeSet<String> =
            meaning.roles.iter().take(1).flatten().flat_map(named).collect();
        let there = names.into_iter().filter_map(|name| {
            let mut one = alternative.clone();
            one.claims.push(self.same(builder, what, meaning.board, &name));
            let (index, pins) = (meaning.board, &board.table.pins);
            only(one, meaning.clone(), |at| {
                let is_there = named(at).contains(&name);
                is_there.then_some(())?;
                match self.tie {
                    Tie::Sequence => self.order(builder, number, index, (pins.get(at.pin)?, &name)),
                    Tie::Together(_) => Some(Vec::new()),
                }
            })
        });
        there.collect()
    }

    fn same(
        &self,
        builder: &mut Builder<'_>,
        what: Together,
        board: BoardIndex,
        name: &str,
    ) -> Claim {
        let group = Group::Tie(board, name.to_ascii_uppercase());
        let resource = self.resource(Tied::Same(what));
        builder.names.shared(resource, group)
    }

    /// Claims by which each candidate shares a unit with all others: no two sets are disjoint.
    fn units(
        &self,
        builder: &mut Builder<'_>,
        index: BoardIndex,
        board: &Board,
        at: &Chosen,
    ) -> Vec<Claim> {
        let Some(own) = self.set(board, at) else { return Vec::new() };
        let apart = self.sets_on(index).filter(|other| own.is_disjoint(other));
        let claims = apart.map(|other| {
            let [own, other] = [&own, other].map(words);
            let (one, two) = (own.clone().min(other.clone()), own.clone().max(other));
            let resource = self.resource(Tied::Units(one, two));
            builder.names.shared(resource, Group::Tie(index, own))
        });
        claims.collect()
    }

    fn sets_on(&self, board: BoardIndex) -> impl Iterator<Item = &Units> {
        self.sets.get(&board).into_iter().flatten()
    }

    /// The units that can serve a candidate.
    fn set(&self, board: &Board, at: &Chosen) -> Option<Units> {
        let usage: &Usage = board.table.pins.get(at.pin)?.usages.get(at.usage?)?;
        let placement = &self.connections.first()?.placement;
        let fixed = placement.unit.as_ref().map(|unit| unit.value.as_str());
        let units: Units = units_of(board, usage, fixed).into_iter().collect();
        (!units.is_empty()).then_some(units)
    }

    fn order(
        &self,
        builder: &mut Builder<'_>,
        number: u16,
        index: BoardIndex,
        (pin, header): (&Pin, &str),
    ) -> Option<Vec<Claim>> {
        let position = pin.position_at(header)?;
        let places = self.places.get(&(index, header.to_owned()))?;
        let own = places.iter().position(|place| place == position)?;
        let mut claims = Vec::new();
        let mut claim = |element: u16, place: usize, word: &str| {
            let resource = self.resource(Tied::Place(element, index, header.to_owned(), place));
            claims.push(builder.names.shared(resource, Group::Tie(index, word.to_owned())));
        };
        if usize::from(number) + 1 < self.connections.len() {
            (0..=own).for_each(|place| claim(number, place, "before"));
        }
        if let Some(before) = number.checked_sub(1) {
            (own..places.len()).for_each(|place| claim(before, place, "behind"));
        }
        Some(claims)
    }

    fn resource(&self, what: Tied) -> Resource {
        Resource::Tie(self.part, self.rule.map(|rule| rule.0), what)
    }
}

/// The alternative with the further claims of its candidates, without the candidates that get
/// `None`; `None` if a role has no candidates left.
fn only(
    mut alternative: Alternative,
    mut meaning: Meaning,
    mut claims: impl FnMut(&Chosen) -> Option<Vec<Claim>>,
) -> Option<(Alternative, Meaning)> {
    for (role, chosen) in alternative.roles.iter_mut().zip(&mut meaning.roles) {
        let all = std::mem::take(&mut role.candidates).into_iter();
        for (mut candidate, at) in all.zip(std::mem::take(chosen)) {
            if let Some(claims) = claims(&at) {
                candidate.claims.extend(claims);
                role.candidates.push(candidate);
                chosen.push(at);
            }
        }
        if role.candidates.is_empty() {
            return None;
        }
    }
    Some((alternative, meaning))
}

/// Units as words.
fn words(units: &Units) -> String {
    let units: Vec<&str> = units.iter().map(String::as_str).collect();
    units.join(" ")
}
