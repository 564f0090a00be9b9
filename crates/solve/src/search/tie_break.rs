//! The tie-break: a search with a proved optimum in, its least answer out.
//!
//! An answer is a list of pins (devices in order, roles in order), then of signals, then of
//! alternatives. The least one is found by fixing one entry after another to the least value that
//! still leads to an answer within the limit; the answer at hand saves most of the questions, and
//! most answers to the others are near it (J. C. Beck, *Solution-guided multi-point constructive
//! search for job shop scheduling*, 2007).

use super::canonical::earliest;
use super::{Effort, Engine, Found};
use crate::domains::Pruned;
use crate::index::{AltId, CandId, RoleId};
use crate::model::{Choices, Model};
use crate::problem::DeviceId;

/// Nodes that a question about several values is worth for each of them, where one has not been
/// seen to take more.
const PATIENCE: u64 = 40;

/// A pin, a signal or an alternative, by its number; nothing where there is no such role.
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

    /// Keeps only what gives the entry this value, and settles.
    pub(crate) fn restrict(&mut self, entry: Entry, value: Value) -> Result<(), Pruned> {
        self.restrict_to(entry, &[value])
    }

    /// Keeps only what gives the entry one of these values, which are in order, and settles.
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

    /// The least answer within the limit, given one within it. Leaves the domains restricted to it.
    pub(crate) fn least(&mut self, limit: u64, known: Choices) -> Choices {
        let model = self.model;
        if self.narrow(limit + 1).is_err() {
            return known;
        }
        let mut known = earliest(model, known);
        let mut number = 1;
        for entry in entries(model) {
            if self.settled(entry) {
                continue;
            }
            // What was not possible for one wire is often not possible for the next, so each
            // entry asks about as many values at once as the one before it did in the end.
            number = self.least_value(entry, limit, &mut known, number);
            if self.restrict(entry, entry.of(model, &known)).is_err() {
                return known;
            }
        }
        known
    }

    /// Makes the known answer the one with the least value of the entry. Asks about so many values
    /// at once at first, and returns about how many in the end.
    fn least_value(
        &mut self,
        entry: Entry,
        limit: u64,
        known: &mut Choices,
        number: usize,
    ) -> usize {
        let model = self.model;
        let floor = self.floor(entry, known);
        let mut values = self.values(entry);
        values.retain(|value| *value >= floor);
        let saved = self.flow.save();
        let mark = self.domains.mark();
        let (mut number, mut patience) = (number, PATIENCE);
        // The least first. Where that is not possible, more at once: mostly nothing is, and to show
        // that takes hardly more of many than of one. Where it does, fewer are asked about.
        loop {
            values.truncate(values.partition_point(|v| *v < entry.of(model, known)));
            if values.is_empty() || self.progress.stopped {
                return number;
            }
            let some = number.min(values.len());
            let before = self.progress.nodes;
            let many = Effort::Nodes(before + patience.saturating_mul(some as u64));
            self.progress.effort = if some > 1 { many } else { Effort::Any };
            let (asked, _) = values.split_at(some);
            let restricted = self.restrict_to(entry, asked);
            let found = restricted.ok().and_then(|()| self.ask(limit, known));
            self.back(mark, &saved);
            let unknown = self.progress.stopped && !self.cancel.is_over();
            self.progress.effort = Effort::Any;
            match found {
                Some((_, better)) => {
                    *known = earliest(model, better);
                    number = 1;
                }
                None if unknown => number = some / 2,
                None if self.progress.stopped => return number,
                None => {
                    if some == 1 {
                        patience = patience.max(self.progress.nodes - before);
                    }
                    values.drain(..some);
                    number = some * 4;
                }
            }
            self.progress.stopped &= !unknown;
        }
    }

    /// An answer within the limit, looked for near the known one where the bounds leave any.
    fn ask(&mut self, limit: u64, known: &Choices) -> Option<Found> {
        let saved = self.flow.save();
        let mark = self.domains.mark();
        let found = if self.narrow_once(limit + 1).is_ok() {
            let near = self.search_near(limit + 1, known);
            near.or_else(|| self.ask_all(limit))
        } else {
            None
        };
        self.back(mark, &saved);
        found
    }

    /// Any answer within the limit.
    fn ask_all(&mut self, limit: u64) -> Option<Found> {
        let few = self.progress.more(PATIENCE);
        let (found, is_open) = self.within(few, |engine| engine.search(limit + 1, true));
        if !is_open || self.progress.stopped {
            return found;
        }
        // Devices that are alike stand together in the program, and differ by now.
        self.renew_program();
        self.search(limit + 1, true)
    }

    /// Interchangeable devices, and bundles, stand in order in the least answer, so a later one
    /// starts where the one before it stands.
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
