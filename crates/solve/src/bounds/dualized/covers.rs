//! Covers: from facilities and their capacities, the number of them that must be open.
//!
//! These are the cover inequalities of capacitated facility location (K. Aardal, Y. Pochet and
//! L. A. Wolsey, *Capacitated facility location: valid inequalities and facets*, 1995). Without
//! them the bound opens a fraction of a bus for each device.

use super::{Dualized, Link, Tie};
use crate::index::{AltId, FacilityId, IdVec, PriceId};
use crate::model::{Holding, Model};
use crate::problem::{DeviceId, ResourceId};
use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet};

/// Facilities of which at least `need` must be open.
#[derive(Clone, Debug, Default)]
pub(crate) struct Cover {
    pub(crate) members: Vec<FacilityId>,
    pub(crate) need: usize,
    /// The other facilities that the devices can choose.
    pub(crate) small: Vec<FacilityId>,
    pub(crate) devices: Vec<DeviceId>,
}

impl Dualized {
    /// Finds facilities that the same devices choose from, and the least number of them that is
    /// needed.
    pub(super) fn find_covers(&mut self, model: &Model) {
        let limited = self.limited();
        let family = self.families(model, &limited);
        let mut devices: BTreeMap<FacilityId, Vec<DeviceId>> = BTreeMap::new();
        for device in model.devices {
            let mut alts = model.alts.of(device).iter().map(|alt| self.serving(alt, &limited));
            let first = alts.next().flatten();
            if let Some(facility) = first.filter(|_| alts.all(|facility| facility.is_some())) {
                devices.entry(family[facility]).or_default().push(device);
            }
        }
        for (number, devices) in devices {
            let of_family = family.enumerate().filter(|f| *f.1 == number);
            let room = of_family.map(|(f, _)| (self.capacity(model, f).max(1), f)).collect();
            self.add_covers(&devices, room);
        }
    }

    /// For each facility, whether it has something that each of its users takes for itself.
    fn limited(&self) -> IdVec<FacilityId, bool> {
        let mut limited = IdVec::same(false, self.facilities.len());
        for (_, tie) in &self.ties {
            if let Tie::Ticket(facility, _) = tie {
                limited[*facility] = true;
            }
        }
        limited
    }

    /// The facility in which an alternative takes a place: its only one, or the first that is
    /// limited. Its other facilities express what it shares with the other connections of its part.
    fn serving(&self, alt: AltId, limited: &IdVec<FacilityId, bool>) -> Option<FacilityId> {
        match &self.alt_facilities[alt] {
            [facility] => Some(*facility),
            several => several.iter().copied().find(|facility| limited[*facility]),
        }
    }

    /// For each facility, the first of those that the same devices choose from.
    fn families(
        &self,
        model: &Model,
        limited: &IdVec<FacilityId, bool>,
    ) -> IdVec<FacilityId, FacilityId> {
        let mut family: IdVec<FacilityId, FacilityId> = self.facilities.ids().iter().collect();
        for device in model.devices {
            let alts = model.alts.of(device).iter();
            let mut all = alts.filter_map(|alt| self.serving(alt, limited));
            let Some(first) = all.next() else { continue };
            let target = family[first];
            for other in all {
                let old = family[other];
                family.iter_mut().filter(|f| **f == old).for_each(|f| *f = target);
            }
        }
        family
    }

    /// If the small facilities have no room for all devices, some of the larger ones must be open.
    /// Adds a cover for each size at which more of them are needed; each cover contains the one
    /// before.
    fn add_covers(&mut self, devices: &[DeviceId], mut room: Vec<(usize, FacilityId)>) {
        room.sort_by_key(|&(room, facility)| (Reverse(room), facility));
        let mut last = 0;
        for number in 1..=room.len() {
            let (great, small) = room.split_at(number);
            if great.last().map(|g| g.0) == small.first().map(|s| s.0) {
                continue;
            }
            let rest = small.iter().fold(0_usize, |sum, s| sum.saturating_add(s.0));
            let mut left = devices.len().saturating_sub(rest);
            let mut need = 0;
            for (room, _) in great {
                if left == 0 {
                    break;
                }
                left = left.saturating_sub(*room);
                need += 1;
            }
            if need > last {
                last = need;
                let members = great.iter().map(|g| g.1).collect();
                let small = small.iter().map(|s| s.1).collect();
                self.covers.push(Cover { members, need, small, devices: devices.to_vec() });
            }
        }
    }

    /// The resources that limit how many devices a facility can serve: of those that each user
    /// holds alone, the ones that [`Self::capacity`] counts.
    pub(crate) fn slots(&self, model: &Model, number: FacilityId) -> Vec<ResourceId> {
        let facility = &self.facilities[number];
        let tied: BTreeMap<PriceId, ResourceId> = self
            .ties
            .iter()
            .filter_map(|(price, tie)| match tie {
                Tie::Ticket(of, resource) if *of == number => Some((*price, *resource)),
                Tie::Ticket(..) | Tie::Link(..) | Tie::Rule(..) => None,
            })
            .collect();
        let link = |prices: &[PriceId]| facility.links.iter().find(|l| prices.contains(&l.0));
        let mut slots = BTreeSet::new();
        for &alt in &facility.alts {
            let mut roles = model.roles.of(alt).iter();
            let role = roles.find(|role| model.holding[*role] == Holding::Own);
            let cands = role.map(|role| model.cands.of(role)).unwrap_or_default();
            let of_cands: Option<Vec<&Link>> =
                cands.iter().map(|id| link(&self.cand_prices[id])).collect();
            let links = of_cands.filter(|links| !links.is_empty());
            let links = links.unwrap_or_else(|| link(&self.alt_prices[alt]).into_iter().collect());
            slots.extend(links.iter().filter_map(|link| tied.get(&link.0)).copied());
        }
        slots.into_iter().collect()
    }

    /// The most devices that a facility can serve: no more than it has links, and no more than
    /// there are pins for the first unshared wire that each of them needs.
    fn capacity(&self, model: &Model, facility: FacilityId) -> usize {
        let facility = &self.facilities[facility];
        let link = |prices: &[PriceId]| facility.links.iter().find(|l| prices.contains(&l.0));
        let mut links: Option<BTreeSet<&Link>> = Some(BTreeSet::new());
        let mut pins = Some(BTreeSet::new());
        for &alt in &facility.alts {
            let mut roles = model.roles.of(alt).iter();
            let role = roles.find(|role| model.holding[*role] == Holding::Own);
            let cands = role.map(|role| model.cands.of(role)).unwrap_or_default();
            match (&mut pins, role) {
                (Some(pins), Some(_)) => pins.extend(cands.iter().map(|id| model.cand[id].pin)),
                _ => pins = None,
            }
            let of_cands: Option<Vec<_>> =
                cands.iter().map(|id| link(&self.cand_prices[id])).collect();
            let found = match of_cands.filter(|links| !links.is_empty()) {
                Some(links) => Some(links),
                None => link(&self.alt_prices[alt]).map(|own| vec![own]),
            };
            match (&mut links, found) {
                (Some(links), Some(found)) => links.extend(found),
                _ => links = None,
            }
        }
        let links = links.map(|set| set.iter().map(|l| l.1 as usize).sum());
        let pins = pins.map(|set| set.len());
        [links, pins].into_iter().flatten().min().unwrap_or(usize::MAX)
    }
}
