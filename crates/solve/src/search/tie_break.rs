//! The tie-break: a search with a proved optimum in, its least answer out.
//!
//! An answer is a list of pins (devices in order, roles in order), then of signals, then of
//! alternatives. The least one is found by fixing one entry after another to the least value that
//! still leads to an answer within the limit. The known answer saves most of the questions, and
//! most answers to the others are near it (J. C. Beck, *Solution-guided multi-point constructive
//! search for job shop scheduling*, 2007).
//!
//! None of these answers is better than another, so a question is worth only a bounded effort. Once
//! that is spent, the answer keeps the value that it has. The effort is counted in work, not in
//! time, so that the same problem has the same answer on every machine.

use super::canonical::earliest;
use super::{Budget, Effort, Engine, Found};
use crate::domains::Pruned;
use crate::index::{AltId, CandId, RoleId};
use crate::model::{Choices, Model};
use crate::problem::DeviceId;

/// A pin, a signal or an alternative, by its number; `None` if there is no such role.
pub(crate) type Value = Option<u32>;

/// One entry of the list by which answers are ordered.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Entry {
    /// Pin of the device's role; `None` (no such role) comes first.
    Pin(DeviceId, usize),
    /// Signal of the device's role.
    Signal(DeviceId, usize),
    /// Alternative of the device.
    Alternative(DeviceId),
}

/// All entries in order.
pub(crate) fn entries(model: &Model) -> Vec<Entry> {
    let positions = |device: DeviceId| 0..model.demands.of(device).len();
    let pairs = || model.devices.iter().flat_map(|d| positions(d).map(move |p| (d, p)));
    let pins = pairs().map(|(d, p)| Entry::Pin(d, p));
    let signals = pairs().map(|(d, p)| Entry::Signal(d, p));
    pins.chain(signals).chain(model.devices.iter().map(Entry::Alternative)).collect()
}

impl Entry {
    fn of_cand(self, model: &Model, id: CandId) -> Value {
        match self {
            Self::Pin(..) => Some(model.cand[id].pin.0),
            Self::Signal(..) => Some(model.cand[id].signal.0),
            Self::Alternative(_) => None,
        }
    }

    /// The value of the entry in a complete choice.
    pub(crate) fn of(self, model: &Model, choices: &Choices) -> Value {
        match self {
            Self::Alternative(device) => Some(choices[device].alt.0),
            Self::Pin(device, position) | Self::Signal(device, position) => {
                choices[device].cands.get(position).and_then(|&id| self.of_cand(model, id))
            }
        }
    }

    fn device(self) -> DeviceId {
        let (Self::Pin(device, _) | Self::Signal(device, _) | Self::Alternative(device)) = self;
        device
    }

    /// The role that the entry is about in an alternative of its device, if there is one.
    fn role(self, model: &Model, alt: AltId) -> Option<RoleId> {
        match self {
            Self::Pin(_, position) | Self::Signal(_, position) => model.roles.of(alt).nth(position),
            Self::Alternative(_) => None,
        }
    }
}

/// How far the tie-break has got.
struct Least {
    /// The greatest weight that an answer may have.
    limit: u64,
    known: Choices,
    /// The number of values that the next question is about. What was impossible for one wire is
    /// often impossible for the next, so each entry begins with the number that the one before
    /// ended with.
    number: usize,
    budget: Budget,
    /// Whether alike devices are put in order: only if nothing distinguishes them by now.
    in_order: bool,
    /// Whether each entry so far has been shown to be the least.
    is_proved: bool,
}

impl Least {
    /// Continues from a smaller answer.
    fn improve(&mut self, model: &Model, better: Choices) {
        // Reordering may change an entry that was given up, which is fixed by now.
        let may_reorder = self.is_proved && self.in_order;
        self.known = if may_reorder { earliest(model, better) } else { better };
        self.number = 1;
    }
}

impl Engine<'_> {
    /// The values that an entry may still have, in order.
    pub(crate) fn values(&self, entry: Entry) -> Vec<Value> {
        let model = self.model;
        let mut values = Vec::new();
        for alt in self.domains.alts(model, entry.device()) {
            if matches!(entry, Entry::Alternative(_)) {
                values.push(Some(alt.0));
            } else if let Some(role) = entry.role(model, alt) {
                let cands = self.domains.cands(model, role);
                values.extend(cands.map(|id| entry.of_cand(model, id)));
            } else {
                values.push(None);
            }
        }
        values.sort_unstable();
        values.dedup();
        values
    }

    /// Whether the entry has one value left.
    pub(crate) fn settled(&self, entry: Entry) -> bool {
        self.domains.decided(entry.device()).is_some_and(|alt| {
            let role = entry.role(self.model, alt);
            role.is_none_or(|role| self.domains.chosen(role).is_some())
        })
    }

    /// Keeps only the choices that give the entry this value, and settles.
    pub(crate) fn restrict(&mut self, entry: Entry, value: Value) -> Result<(), Pruned> {
        self.restrict_to(entry, &[value])
    }

    /// Keeps only the choices that give the entry one of these values, which are in order, and
    /// settles.
    fn restrict_to(&mut self, entry: Entry, values: &[Value]) -> Result<(), Pruned> {
        let model = self.model;
        let alts = model.alts.of(entry.device());
        let keeps = |value: Value| values.binary_search(&value).is_ok();
        for alt in alts {
            let Some(role) = entry.role(model, alt) else {
                let whole = matches!(entry, Entry::Alternative(_)).then_some(alt.0);
                if !keeps(whole) {
                    self.domains.remove_alt(model, alt)?;
                }
                continue;
            };
            for id in model.cands.of(role) {
                if !keeps(entry.of_cand(model, id)) {
                    self.domains.remove_cand(model, id)?;
                }
            }
        }
        for alt in alts {
            if self.domains.has_alt(alt) {
                self.domains.touch(model.alt_board[alt]);
            }
        }
        self.settle()
    }

    /// The least answer within the limit, as far as the effort shows, given an answer within it.
    /// Leaves the domains restricted to it.
    pub(crate) fn least(&mut self, limit: u64, known: Choices) -> Choices {
        if self.narrow(limit + 1).is_err() {
            return known;
        }
        let known = earliest(self.model, known);
        self.least_from(limit, known, true)
    }

    /// Like [`Self::least`], but of domains in which alike devices may differ.
    pub(crate) fn least_here(&mut self, limit: u64, known: Choices) -> Choices {
        if self.narrow(limit + 1).is_err() {
            return known;
        }
        self.least_from(limit, known, false)
    }

    fn least_from(&mut self, limit: u64, known: Choices, in_order: bool) -> Choices {
        let model = self.model;
        let budget = Budget::new();
        let mut answer = Least { limit, known, number: 1, budget, in_order, is_proved: true };
        for entry in entries(model) {
            if self.settled(entry) {
                continue;
            }
            self.least_value(entry, &mut answer);
            if self.restrict(entry, entry.of(model, &answer.known)).is_err() {
                break;
            }
        }
        answer.known
    }

    /// Makes the known answer the one with the least value of the entry, as far as the effort shows.
    fn least_value(&mut self, entry: Entry, answer: &mut Least) {
        let model = self.model;
        let floor = answer.in_order.then(|| self.floor(entry, &answer.known)).flatten();
        let mut values = self.values(entry);
        values.retain(|value| *value >= floor);
        let saved = self.flow.save();
        let mark = self.domains.mark();
        // Ask about the least value first. If it is impossible, ask about more at once: usually all
        // are impossible, and showing that for many takes hardly more work than for one. If it does
        // take more, ask about fewer.
        loop {
            values.truncate(values.partition_point(|v| *v < entry.of(model, &answer.known)));
            if values.is_empty() || self.progress.stopped {
                return;
            }
            let some = answer.number.min(values.len());
            let (asked, _) = values.split_at(some);
            let before = self.progress.work;
            self.progress.effort = Effort::Work(before + answer.budget.next());
            let restricted = self.restrict_to(entry, asked);
            let found = restricted.ok().and_then(|()| self.ask(answer.limit, &answer.known));
            self.back(mark, &saved);
            answer.budget.spend(self.progress.work - before);
            let is_unknown = self.progress.stopped && !self.cancel.is_over();
            self.progress.effort = Effort::Any;
            self.progress.stopped &= !is_unknown;
            match found {
                Some((_, better)) => answer.improve(model, better),
                None if is_unknown && some > 1 => answer.number = some / 2,
                None if is_unknown => {
                    answer.is_proved = false;
                    return;
                }
                None => {
                    values.drain(..some);
                    answer.number = some * 4;
                }
            }
        }
    }

    /// An answer within the limit, searched for near the known one if the bounds leave any.
    fn ask(&mut self, limit: u64, known: &Choices) -> Option<Found> {
        let saved = self.flow.save();
        let mark = self.domains.mark();
        let found = if self.narrow_once(limit + 1).is_ok() {
            let near = self.search_near(limit + 1, known);
            near.or_else(|| self.search(limit + 1, true))
        } else {
            None
        };
        self.back(mark, &saved);
        found
    }

    /// The least value that an entry can have. Interchangeable devices, and bundles, are in order
    /// in the least answer, so a later one starts no lower than the one before it.
    fn floor(&self, entry: Entry, known: &Choices) -> Value {
        let Entry::Pin(device, 0) = entry else { return None };
        let model = self.model;
        let class = model.class_of(model.class[device]);
        let alike = class.take_while(|d| *d < device).last();
        let first = model.bundles.place(device).filter(|place| place.position == 0);
        let bundle = first.and_then(|place| {
            let before = model.bundles.family(place).get(place.bundle.checked_sub(1)?)?;
            before.devices.first().copied()
        });
        let pin = |device| Entry::Pin(device, 0).of(model, known);
        alike.and_then(pin).max(bundle.and_then(pin))
    }
}
