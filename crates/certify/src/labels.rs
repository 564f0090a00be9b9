//! The names of everything in a certificate.

use std::collections::{BTreeMap, BTreeSet};

/// Names of an alternative and its roles.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct AlternativeLabels {
    /// Its name, unique in the device.
    pub name: String,
    /// The names of its roles, unique in the alternative.
    pub roles: Vec<String>,
}

/// A name for each number of a problem; names of one kind are distinct.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Labels {
    /// Boards.
    pub boards: Vec<String>,
    /// Pins.
    pub pins: Vec<String>,
    /// Devices.
    pub devices: Vec<String>,
    /// For each device, its alternatives.
    pub alternatives: Vec<Vec<AlternativeLabels>>,
    /// Signals by their rank.
    pub signals: BTreeMap<u32, String>,
    /// Resources.
    pub resources: Vec<String>,
    /// Groups of holders.
    pub groups: Vec<String>,
    /// Soft rules.
    pub rules: Vec<String>,
    /// DMA users.
    pub dma: Vec<String>,
    /// DMA streams.
    pub streams: Vec<String>,
}

impl Labels {
    /// The labels of some devices only.
    pub(crate) fn with_devices(&self, devices: &[usize]) -> Self {
        let mut labels = self.clone();
        labels.devices = pick(&self.devices, devices);
        labels.alternatives = pick(&self.alternatives, devices);
        labels
    }
}

/// The items at the given places.
pub(crate) fn pick<T: Clone>(all: &[T], places: &[usize]) -> Vec<T> {
    places.iter().filter_map(|place| all.get(*place)).cloned().collect()
}

/// Adds numbers to names that have occurred before.
pub fn distinct(names: impl Iterator<Item = String>) -> Vec<String> {
    let mut seen = BTreeSet::new();
    let mut distinct = Vec::new();
    for name in names {
        let mut candidate = name.clone();
        for number in 2_u32.. {
            if seen.insert(candidate.clone()) {
                break;
            }
            candidate = format!("{name} ({number})");
        }
        distinct.push(candidate);
    }
    distinct
}
