//! Known sets of devices: what the sets with and without an answer imply for other sets.
//!
//! Fewer devices only make a problem easier, and interchangeable devices can replace each other. So
//! a set has an answer if a known set with an answer has at least as many devices of each class. It
//! has none if a known set without one, a nogood, has at most as many. Such a map of all sets is
//! from M. H. Liffiton et al., *Fast, flexible MUS enumeration*, 2016.

use super::solve::alike;
use crate::answer::Fault;
use crate::index::Id;
use crate::problem::{DeviceId, Problem};
use std::collections::BTreeMap;

/// A class with this many members is worth a question whose answer holds for all of them.
pub(crate) const LARGE: usize = 3;

/// Number of devices of each class.
type Counts = Vec<u32>;

/// The sets known so far.
#[derive(Clone, Debug, Default)]
pub(crate) struct KnownSets {
    /// Class of each device.
    class: Vec<usize>,
    classes: usize,
    with_answer: Vec<Counts>,
    nogoods: Vec<Counts>,
}

/// Whether `one` has at most as many devices of each class as `other`.
fn within(one: &Counts, other: &Counts) -> bool {
    one.iter().zip(other).all(|(one, other)| one <= other)
}

impl KnownSets {
    /// At first, only the classes of interchangeable devices are known.
    pub(crate) fn new(problem: &Problem) -> Result<Self, Fault> {
        let mut numbers = BTreeMap::new();
        let number = |first: &usize| {
            let next = numbers.len();
            *numbers.entry(*first).or_insert(next)
        };
        let class: Vec<usize> = alike(problem)?.iter().map(number).collect();
        Ok(Self { class, classes: numbers.len(), ..Self::default() })
    }

    fn counts(&self, devices: &[DeviceId]) -> Counts {
        let mut counts = vec![0; self.classes];
        let classes = devices.iter().filter_map(|device| self.class.get(device.index()));
        for class in classes {
            if let Some(count) = counts.get_mut(*class) {
                *count += 1;
            }
        }
        counts
    }

    /// Whether the devices have an answer, if that follows from what is known.
    pub(crate) fn tells(&self, devices: &[DeviceId]) -> Option<bool> {
        let counts = self.counts(devices);
        if self.with_answer.iter().any(|known| within(&counts, known)) {
            return Some(true);
        }
        self.nogoods.iter().any(|known| within(known, &counts)).then_some(false)
    }

    pub(crate) fn learn(&mut self, devices: &[DeviceId], has_answer: bool) {
        let counts = self.counts(devices);
        if has_answer {
            self.with_answer.retain(|known| !within(known, &counts));
            self.with_answer.push(counts);
        } else {
            self.nogoods.retain(|known| !within(&counts, known));
            self.nogoods.push(counts);
        }
    }

    /// The classes with many members among these devices.
    pub(crate) fn large_classes(&self, devices: &[DeviceId]) -> Vec<Vec<DeviceId>> {
        let mut members: BTreeMap<usize, Vec<DeviceId>> = BTreeMap::new();
        for &device in devices {
            if let Some(class) = self.class.get(device.index()) {
                members.entry(*class).or_default().push(device);
            }
        }
        members.into_values().filter(|class| class.len() >= LARGE).collect()
    }
}
