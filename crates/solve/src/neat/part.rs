//! The parts whose neatness the search decides: layout and domains in, parts and their pins out.

use super::layout::{Layout, Neatness, Used};
use super::live::Live;
use super::pins::PinSet;
use crate::domains::Domains;
use crate::model::{Choices, Model};
use crate::problem::{DeviceId, PinId};
use std::collections::{BTreeMap, BTreeSet};

/// A part that may be wired more or less neatly.
#[derive(Clone, Debug)]
pub(super) struct Part {
    pub(super) devices: Vec<DeviceId>,
    /// The pins that its wires could be on before the search.
    pub(super) live: Live,
}

/// All parts.
#[derive(Clone, Debug, Default)]
pub(super) struct Parts {
    pub(super) open: Vec<Part>,
    /// The neatness of those that are equally neat on all their pins: most have one wire.
    pub(super) settled: Neatness,
}

impl Parts {
    pub(super) fn new(model: &Model, domains: &Domains, layout: &Layout) -> Self {
        let mut by_part: BTreeMap<u32, Vec<DeviceId>> = BTreeMap::new();
        for (device, part) in model.devices.iter().zip(&layout.parts) {
            by_part.entry(*part).or_default().push(device);
        }
        let mut parts = Self::default();
        for devices in by_part.into_values() {
            let live = Live::new(model, domains, &devices);
            match same_on_all(layout, &live) {
                Some(neatness) => parts.settled += neatness,
                None => parts.open.push(Part { devices, live }),
            }
        }
        parts
    }

    /// How neat a wiring is.
    pub(super) fn neatness(&self, model: &Model, layout: &Layout, choices: &Choices) -> Neatness {
        let of = |part: &Part| used(model, layout, choices, &part.devices).neatness;
        self.open.iter().map(of).fold(self.settled, |sum, one| sum + one)
    }
}

/// The contacts that the devices of a part use in a wiring.
pub(super) fn used(
    model: &Model,
    layout: &Layout,
    choices: &Choices,
    devices: &[DeviceId],
) -> Used {
    let cands = devices.iter().flat_map(|device| &choices[*device].cands);
    let pins: BTreeSet<PinId> = cands.map(|id| model.cand[*id].pin).collect();
    layout.used_of(&pins)
}

/// For each side that a part uses, the first and the last contact.
pub(super) type Runs = BTreeMap<u32, (u32, u32)>;

/// The contacts between which a part is on each side that it uses.
pub(super) fn runs_in_use(layout: &Layout, used: &Used) -> Runs {
    let mut runs = Runs::new();
    for (pin, number) in &used.contacts {
        if let Some(contact) = layout.of(*pin).get(*number) {
            let (first, last) = runs.entry(contact.side).or_insert((contact.index, contact.index));
            (*first, *last) = ((*first).min(contact.index), (*last).max(contact.index));
        }
    }
    runs
}

/// The pins of a part that are between these contacts, with those that are on no connector.
pub(super) fn pins_between(layout: &Layout, live: &Live, runs: &Runs) -> PinSet {
    let is_in = |pin: &PinId| {
        let contacts = layout.of(*pin);
        let is_in = |(first, last): &(u32, u32), index| (*first..=*last).contains(&index);
        contacts.is_empty()
            || contacts.iter().any(|at| runs.get(&at.side).is_some_and(|run| is_in(run, at.index)))
    };
    let pins = live.pins();
    pins.common(&pins).filter(is_in).collect()
}

/// The neatness of a part if it is the same on all its pins.
fn same_on_all(layout: &Layout, live: &Live) -> Option<Neatness> {
    let pins = live.pins();
    let (mut some, mut none) = (false, false);
    for pin in pins.common(&pins) {
        let is_on_connector = !layout.of(pin).is_empty();
        some |= is_on_connector;
        none |= !is_on_connector;
    }
    match (some, none) {
        (false, _) => Some(Neatness::default()),
        (true, false) if live.most_wires() == 1 => Some(Neatness { sides: 1, span: 0 }),
        (true, _) => None,
    }
}
