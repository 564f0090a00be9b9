//! Where pins are on connectors, and how neat the wires of a part are.
//!
//! In: for each pin its contacts, for each device its part. Out: how many sides of connectors the
//! parts use, and how far their wires reach along them. A pin may have several contacts: each part
//! uses the one that is best for its wires.

use crate::answer::Answer;
use crate::problem::{PinId, Problem};
use std::collections::{BTreeMap, BTreeSet};
use std::ops::{Add, AddAssign, Sub};

/// A contact of a connector.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Contact {
    /// The side of the connector: a number that no other side of any connector has.
    pub side: u32,
    /// The place along the side. The rows of a double-row connector count as one.
    pub index: u32,
}

/// Where everything is.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Layout {
    /// For each device of the problem, the part that it belongs to.
    pub parts: Vec<u32>,
    /// For each pin of the problem, its contacts; none if it is on no connector.
    pub contacts: Vec<Vec<Contact>>,
}

/// How neat a wiring is: less is neater, compared in field order.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Neatness {
    /// Sides of connectors in use, summed over parts.
    pub sides: u32,
    /// The distance of the first from the last contact in use, summed over these sides.
    pub span: u32,
}

impl Add for Neatness {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { sides: self.sides + other.sides, span: self.span + other.span }
    }
}

impl AddAssign for Neatness {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl Sub for Neatness {
    type Output = Self;

    /// What is left of a sum without one of its terms.
    fn sub(self, other: Self) -> Self {
        Self {
            sides: self.sides.saturating_sub(other.sides),
            span: self.span.saturating_sub(other.span),
        }
    }
}

/// The contacts that a part uses.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Used {
    /// For each pin, which of its contacts; pins on no connector are left out.
    pub contacts: BTreeMap<PinId, usize>,
    /// How neat that is.
    pub neatness: Neatness,
    /// Whether no other contacts of the pins are neater.
    pub is_least: bool,
}

impl Layout {
    /// Whether no pin is on a connector, so that all wirings are equally neat.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.contacts.iter().all(Vec::is_empty)
    }

    /// For each part with wires, the contacts that it uses.
    #[must_use]
    pub fn used(&self, problem: &Problem, answer: &Answer) -> BTreeMap<u32, Used> {
        let mut pins: BTreeMap<u32, BTreeSet<PinId>> = BTreeMap::new();
        let devices = problem.devices.iter().zip(&answer.choices).zip(&self.parts);
        for ((device, choice), part) in devices {
            let roles = device.alternatives.get(choice.alternative).map(|one| &one.roles);
            let wires = roles.into_iter().flatten().zip(&choice.candidates);
            let wires = wires.filter_map(|(role, index)| role.candidates.get(*index));
            pins.entry(*part).or_default().extend(wires.map(|wire| wire.pin));
        }
        pins.into_iter().map(|(part, pins)| (part, self.used_of(&pins))).collect()
    }

    /// How neat a wiring is.
    #[must_use]
    pub fn neatness(&self, problem: &Problem, answer: &Answer) -> Neatness {
        self.used(problem, answer).values().fold(Neatness::default(), |sum, one| sum + one.neatness)
    }

    pub(super) fn of(&self, pin: PinId) -> &[Contact] {
        self.contacts.get(pin.0 as usize).map_or(&[], Vec::as_slice)
    }

    /// The contacts by which a part uses these pins most neatly.
    pub(super) fn used_of(&self, pins: &BTreeSet<PinId>) -> Used {
        let mut on: Vec<(PinId, &[Contact])> = pins
            .iter()
            .map(|pin| (*pin, self.of(*pin)))
            .filter(|(_, all)| !all.is_empty())
            .collect();
        // Pins without a choice first: they decide which sides are in use anyway.
        on.sort_by_key(|(pin, all)| (all.len(), *pin));
        let mut best = Best { chosen: Vec::new(), least: None, steps: 0 };
        best.place(&on, &mut Vec::new(), &mut Vec::new());
        let contacts = on.iter().map(|(pin, _)| *pin).zip(best.chosen).collect();
        let neatness = best.least.unwrap_or_default();
        Used { contacts, neatness, is_least: best.steps < MOST }
    }
}

/// The most steps in which the contacts of one part are chosen.
const MOST: u32 = 20_000;

/// The best choice of contacts so far.
struct Best {
    chosen: Vec<usize>,
    least: Option<Neatness>,
    steps: u32,
}

impl Best {
    /// Tries all contacts of the pins that have none yet. `open` has the sides in use with their
    /// first and last contacts. One more wire never makes a part neater, so most is cut off early.
    fn place(
        &mut self,
        pins: &[(PinId, &[Contact])],
        open: &mut Vec<(u32, u32, u32)>,
        chosen: &mut Vec<usize>,
    ) {
        let neatness = Neatness {
            sides: open.len() as u32,
            span: open.iter().map(|(_, first, last)| last - first).sum(),
        };
        if self.least.is_some_and(|least| neatness >= least || self.steps >= MOST) {
            return;
        }
        self.steps += 1;
        let Some(((_, contacts), rest)) = pins.split_first() else {
            self.least = Some(neatness);
            self.chosen.clone_from(chosen);
            return;
        };
        let mut order: Vec<(bool, u32, usize)> = Vec::with_capacity(contacts.len());
        for (number, contact) in contacts.iter().enumerate() {
            let on = open.iter().find(|(side, ..)| *side == contact.side);
            let farther = on.map_or(0, |(_, first, last)| {
                first.saturating_sub(contact.index) + contact.index.saturating_sub(*last)
            });
            order.push((on.is_none(), farther, number));
        }
        order.sort_unstable();
        for (is_new, _, number) in order {
            let Some(contact) = contacts.get(number) else { continue };
            let before = open.clone();
            if is_new {
                open.push((contact.side, contact.index, contact.index));
            }
            for (side, first, last) in open.iter_mut() {
                if *side == contact.side {
                    (*first, *last) = ((*first).min(contact.index), (*last).max(contact.index));
                }
            }
            chosen.push(number);
            self.place(rest, open, chosen);
            chosen.pop();
            *open = before;
        }
    }
}
