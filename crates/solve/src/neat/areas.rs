//! The areas on which a part can have its wires, neatest first.
//!
//! An area is a run of contacts on each of a few sides of connectors. What a part has in an area is
//! at least as neat as the area, and every wiring of the part fills some area exactly. So whoever
//! goes through the areas in order goes through all wirings of the part, neatest first.

use super::layout::{Layout, Neatness};
use super::live::Live;
use super::pins::PinSet;
use crate::problem::PinId;
use std::collections::BTreeMap;

/// The most areas that are kept of a part.
const MOST: usize = 2_000;
/// The most sides of an area.
const SIDES: u32 = 4;

/// Pins between two contacts on each of some sides.
#[derive(Clone, Debug)]
pub(super) struct Area {
    pub(super) neatness: Neatness,
    pub(super) pins: PinSet,
}

/// The areas of a part.
#[derive(Clone, Debug, Default)]
pub(super) struct Areas {
    /// In order.
    pub(super) all: Vec<Area>,
    /// Of the areas that are left out, none is neater than this.
    pub(super) rest: Neatness,
}

/// Which areas are wanted.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wanted {
    /// Only neater ones than this.
    pub(super) below: Neatness,
    /// Whether the first is enough.
    pub(super) one: bool,
    /// Whether all contacts of a side count as one place.
    pub(super) whole: bool,
}

/// The sides on which a part can be.
pub(super) struct Sides<'a> {
    live: &'a Live,
    /// Pins that are on no connector: on them, a wire counts for nothing.
    loose: PinSet,
    /// For each side, its runs by their length.
    runs: Vec<BTreeMap<u32, Vec<PinSet>>>,
    /// For each side, all pins on it, as a run of no length.
    whole: Vec<BTreeMap<u32, Vec<PinSet>>>,
}

/// The areas that have been found, and the work that is left for it.
struct Collected<'a> {
    all: Vec<Area>,
    wanted: Wanted,
    work: &'a mut u64,
}

impl<'a> Sides<'a> {
    pub(super) fn new(layout: &Layout, live: &'a Live) -> Self {
        let pins = live.pins();
        let all = || pins.common(&pins);
        let mut places: BTreeMap<u32, BTreeMap<u32, Vec<PinId>>> = BTreeMap::new();
        for pin in all() {
            for contact in layout.of(pin) {
                let side = places.entry(contact.side).or_default();
                side.entry(contact.index).or_default().push(pin);
            }
        }
        let on = |side: &BTreeMap<u32, Vec<PinId>>| side.values().flatten().copied().collect();
        Self {
            live,
            loose: all().filter(|pin| layout.of(*pin).is_empty()).collect(),
            whole: places.values().map(|side| BTreeMap::from([(0, vec![on(side)])])).collect(),
            runs: places.values().map(runs).collect(),
        }
    }

    /// The areas that are wanted, as far as this work allows.
    pub(super) fn areas(&self, wanted: Wanted, work: &mut u64) -> Areas {
        let sides = if wanted.whole { &self.whole } else { &self.runs };
        let longest: u32 = sides.iter().filter_map(|side| side.keys().next_back()).sum();
        let mut found = Collected { all: Vec::new(), wanted, work };
        for number in 0..=wanted.below.sides.min(SIDES) {
            for span in 0..=longest {
                let neatness = Neatness { sides: number, span };
                if neatness >= wanted.below {
                    return Areas { all: found.all, rest: wanted.below };
                }
                self.add(sides, neatness, (number, span), &self.loose, &mut found);
                if found.is_enough() {
                    // Of this neatness, some may be left out.
                    let keeps = if wanted.one { 1 } else { 0 };
                    let before = found.all.partition_point(|area| area.neatness < neatness);
                    found.all.truncate(before.max(keeps));
                    return Areas { all: found.all, rest: neatness };
                }
            }
        }
        Areas { all: found.all, rest: Neatness { sides: SIDES + 1, span: 0 }.min(wanted.below) }
    }

    /// Adds the areas with so many more sides, and runs that are so much longer together.
    fn add(
        &self,
        on: &[BTreeMap<u32, Vec<PinSet>>],
        neatness: Neatness,
        (sides, span): (u32, u32),
        pins: &PinSet,
        found: &mut Collected<'_>,
    ) {
        if sides == 0 {
            *found.work = found.work.saturating_sub(self.live.work());
            if span == 0 && self.live.fits(pins) {
                found.all.push(Area { neatness, pins: pins.clone() });
            }
            return;
        }
        for (at, side) in on.iter().enumerate() {
            let rest = on.get(at + 1..).unwrap_or_default();
            let shortest = if sides == 1 { span } else { 0 };
            for (length, runs) in side.range(shortest..=span) {
                for run in runs {
                    if found.is_enough() {
                        return;
                    }
                    let mut more = pins.clone();
                    more.add_all(run);
                    self.add(rest, neatness, (sides - 1, span - length), &more, found);
                }
            }
        }
    }
}

impl Collected<'_> {
    fn is_enough(&self) -> bool {
        *self.work == 0 || self.all.len() > MOST || self.wanted.one && !self.all.is_empty()
    }
}

/// The runs between any two contacts of a side, by their length.
fn runs(side: &BTreeMap<u32, Vec<PinId>>) -> BTreeMap<u32, Vec<PinSet>> {
    let mut runs: BTreeMap<u32, Vec<PinSet>> = BTreeMap::new();
    for first in side.keys() {
        let mut pins = PinSet::default();
        for (last, here) in side.range(first..) {
            here.iter().for_each(|pin| pins.add(*pin));
            runs.entry(last - first).or_default().push(pins.clone());
        }
    }
    runs
}
