//! The tie-break: a search with a proved optimum in, its least answer out.
//!
//! An answer is a list of pins (devices in order, roles in order), then of signals, then of
//! alternatives. The least one is found by fixing one entry after another to the least value that
//! still leads to an answer within the limit; the answer at hand saves most of the questions.
#![expect(clippy::indexing_slicing, reason = "all ids come from the model")]

use crate::domains::Dead;
use crate::model::Model;
use crate::questions::solve::Effort;
use crate::search::canonical::earliest;
use crate::search::{Choices, Engine};

/// Nodes that a question about several values is worth.
const PATIENCE: u64 = 40;

/// One entry of the list by which answers are ordered.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Entry {
    /// Pin of the device's role; `None` (no such role) comes first.
    Pin(usize, usize),
    /// Signal of the device's role.
    Signal(usize, usize),
    /// Alternative of the device.
    Alternative(usize),
}

/// All entries in order.
pub(crate) fn entries(model: &Model) -> Vec<Entry> {
    let positions = |device: usize| 0..model.demand[device + 1] - model.demand[device];
    let pairs = || (0..model.devices).flat_map(|d| positions(d).map(move |p| (d, p)));
    let pins = pairs().map(|(d, p)| Entry::Pin(d, p));
    let signals = pairs().map(|(d, p)| Entry::Signal(d, p));
    pins.chain(signals).chain((0..model.devices).map(Entry::Alternative)).collect()
}

impl Entry {
    fn of_cand(self, model: &Model, id: usize) -> Option<usize> {
        match self {
            Self::Pin(..) => Some(model.cand(id).pin),
            Self::Signal(..) => Some(model.cand(id).signal),
            Self::Alternative(_) => None,
        }
    }

    /// The value of the entry in a complete choice.
    pub(crate) fn of(self, model: &Model, choices: &Choices) -> Option<usize> {
        match self {
            Self::Alternative(device) => Some(choices[device].0),
            Self::Pin(device, position) | Self::Signal(device, position) => {
                choices[device].1.get(position).and_then(|&id| self.of_cand(model, id))
            }
        }
    }
}

impl Engine<'_> {
    /// The values that an entry may still have, in order.
    pub(crate) fn values(&self, entry: Entry) -> Vec<Option<usize>> {
        let model = self.model;
        let mut values = Vec::new();
        match entry {
            Entry::Alternative(device) => {
                return self.domains.alts(model, device).map(Some).collect();
            }
            Entry::Pin(device, position) | Entry::Signal(device, position) => {
                for alt in self.domains.alts(model, device) {
                    let roles = model.roles.range(alt);
                    if position >= roles.len() {
                        values.push(None);
                        continue;
                    }
                    let cands = self.domains.cands(model, roles.start + position);
                    values.extend(cands.map(|id| entry.of_cand(model, id)));
                }
            }
        }
        values.sort_unstable();
        values.dedup();
        values
    }

    /// Whether the entry has one value left.
    pub(crate) fn settled(&self, entry: Entry) -> bool {
        let model = self.model;
        match entry {
            Entry::Alternative(device) => self.domains.decided(device).is_some(),
            Entry::Pin(device, position) | Entry::Signal(device, position) => {
                self.domains.decided(device).is_some_and(|alt| {
                    let roles = model.roles.range(alt);
                    position >= roles.len() || self.domains.pinned(roles.start + position).is_some()
                })
            }
        }
    }

    /// Keeps only what gives the entry this value, and settles.
    pub(crate) fn restrict(&mut self, entry: Entry, value: Option<usize>) -> Result<(), Dead> {
        self.restrict_to(entry, &[value])
    }

    /// Keeps only what gives the entry one of these values, which are in order, and settles.
    fn restrict_to(&mut self, entry: Entry, values: &[Option<usize>]) -> Result<(), Dead> {
        let model = self.model;
        let keeps = |value: Option<usize>| values.binary_search(&value).is_ok();
        match entry {
            Entry::Alternative(device) => {
                for alt in model.alts.range(device) {
                    if !keeps(Some(alt)) {
                        self.domains.kill_alt(model, alt)?;
                    }
                }
            }
            Entry::Pin(device, position) | Entry::Signal(device, position) => {
                for alt in model.alts.range(device) {
                    let roles = model.roles.range(alt);
                    if position >= roles.len() {
                        if !keeps(None) {
                            self.domains.kill_alt(model, alt)?;
                        }
                        continue;
                    }
                    for id in model.cands.range(roles.start + position) {
                        if !keeps(entry.of_cand(model, id)) {
                            self.domains.kill_cand(model, id)?;
                        }
                    }
                }
            }
        }
        let (Entry::Pin(device, _) | Entry::Signal(device, _) | Entry::Alternative(device)) = entry;
        for alt in model.alts.range(device) {
            if self.domains.alt_on(alt) {
                self.domains.touch(model.alt_board[alt]);
            }
        }
        self.settle()
    }

    /// The least answer within the limit, given one within it. Leaves the domains restricted to it.
    pub(crate) fn least(&mut self, limit: u64, known: Choices) -> Choices {
        let model = self.model;
        if self.narrow(limit + 1).is_err() {
            return known;
        }
        let mut known = earliest(model, known);
        let mut start = 1;
        for entry in entries(model) {
            if self.settled(entry) {
                continue;
            }
            let floor = self.floor(entry, &known);
            let mut values = self.values(entry);
            values.retain(|value| *value >= floor);
            let saved = self.flow.save();
            let mark = self.domains.mark();
            // The least first. Where that is not possible, more at once: mostly nothing is, and to
            // show that takes hardly more of many than of one. Where it does, fewer are asked about.
            let mut number = start;
            loop {
                values.truncate(values.partition_point(|v| *v < entry.of(model, &known)));
                if values.is_empty() || self.stopped {
                    break;
                }
                let some = number.min(values.len());
                let many = Effort::Nodes(self.nodes + PATIENCE);
                self.effort = if some > 1 { many } else { Effort::Any };
                let restricted = self.restrict_to(entry, &values[..some]);
                let found = restricted.ok().and_then(|()| self.search(limit + 1, true));
                self.back(mark, &saved);
                let unknown = self.stopped && !self.cancel.is_over();
                self.effort = Effort::Any;
                match found {
                    Some((_, better)) => {
                        known = earliest(model, better);
                        number = 1;
                    }
                    None if unknown => number = some / 2,
                    None if self.stopped => break,
                    None => {
                        values.drain(..some);
                        number = some * 4;
                    }
                }
                self.stopped &= !unknown;
            }
            // What was not possible for one wire is often not possible for the next.
            start = number;
            if self.restrict(entry, entry.of(model, &known)).is_err() {
                return known;
            }
        }
        known
    }

    /// Interchangeable devices stand in order in the least answer, so a later one starts where
    /// the one before it stands.
    fn floor(&self, entry: Entry, known: &Choices) -> Option<usize> {
        let Entry::Pin(device, 0) = entry else { return None };
        let class = self.model.class[device];
        let before = (class..device).rev().find(|&d| self.model.class[d] == class)?;
        Entry::Pin(before, 0).of(self.model, known)
    }
}
