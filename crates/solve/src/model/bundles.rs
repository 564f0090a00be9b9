//! Symmetry of bundles: finds the bundles of devices that can change places as a whole.
//!
//! The connections of a chip, or of an array, are tied by resources and rules of their own, so
//! those of two equal chips are not interchangeable one by one. As a whole they are: swapping the
//! chips, together with whatever ties the connections of each, changes nothing. Each pair of
//! bundles found here is such a swap by construction: all claims and rules of both were compared,
//! and no other device has any of what changes places.

use super::{Model, Part};
use crate::index::{AltId, CandId, IdVec};
use crate::problem::{Claim, DeviceId, ResourceId, RuleId};
use std::collections::{BTreeMap, BTreeSet};

/// A device's family, its bundle, and its position in the bundle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Place {
    pub(crate) family: usize,
    pub(crate) bundle: usize,
    pub(crate) position: usize,
}

/// Devices, in order, that change places one by one with those of another bundle, and their rules.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Bundle {
    pub(crate) devices: Vec<DeviceId>,
    pub(crate) rules: Vec<RuleId>,
}

/// All bundles. Each family lists, in order, the bundles that can replace each other.
#[derive(Clone, Debug, Default)]
pub(crate) struct Bundles {
    pub(crate) families: Vec<Vec<Bundle>>,
    place: IdVec<DeviceId, Option<Place>>,
}

impl Bundles {
    pub(crate) fn new(model: &Model) -> Self {
        let mut bundles =
            Self { families: Vec::new(), place: IdVec::same(None, model.devices.len()) };
        let mut shapes: BTreeMap<Vec<u32>, Vec<DeviceId>> = BTreeMap::new();
        for device in model.class_leaders() {
            shapes.entry(shape(model, device)).or_default().push(device);
        }
        for device in model.class_leaders() {
            let like = shapes.get(&shape(model, device)).into_iter().flatten();
            for &first in like.take_while(|first| **first < device) {
                if bundles.place[device].is_some() {
                    break;
                }
                bundles.join(model, first, device);
            }
        }
        bundles
    }

    /// The place of the device, if it is in a bundle.
    pub(crate) fn place(&self, device: DeviceId) -> Option<Place> {
        self.place[device]
    }

    /// The bundles of a device's family.
    pub(crate) fn family(&self, place: Place) -> &[Bundle] {
        self.families.get(place.family).map_or(&[], Vec::as_slice)
    }

    /// Adds the device to the family of the other one, if their bundles can be swapped.
    fn join(&mut self, model: &Model, first: DeviceId, device: DeviceId) {
        let leads = self.place[first].map(|at| (at.bundle, at.position));
        if leads.is_some_and(|leads| leads != (0, 0)) {
            return;
        }
        let Some((one, other)) = Swap::of(model, first, device) else { return };
        if other.devices.iter().any(|&d| self.place[d].is_some()) {
            return;
        }
        let family = match self.place[first] {
            Some(at) => at.family,
            None if one.devices.iter().any(|&d| self.place[d].is_some()) => return,
            None => {
                self.families.push(Vec::new());
                self.put(self.families.len() - 1, one.clone());
                self.families.len() - 1
            }
        };
        // The first bundle must be the same whichever bundle it is swapped with.
        if self.families.get(family).and_then(|all| all.first()) == Some(&one) {
            self.put(family, other);
        }
    }

    fn put(&mut self, family: usize, bundle: Bundle) {
        let Some(bundles) = self.families.get_mut(family) else { return };
        for (position, &device) in bundle.devices.iter().enumerate() {
            self.place[device] = Some(Place { family, bundle: bundles.len(), position });
        }
        bundles.push(bundle);
    }
}

/// The numbers that two devices must at least have in common; quick to compare.
fn shape(model: &Model, device: DeviceId) -> Vec<u32> {
    let alts = model.alts.of(device);
    let roles = model.roles.of_all(alts);
    let cands = model.cands.of_all(roles);
    let ends = [cands.iter().next(), cands.iter().next_back()].into_iter().flatten();
    let numbers = [alts.len(), roles.len(), cands.len()].into_iter().map(|number| number as u32);
    numbers.chain(ends.map(|id| model.cand[id].pin.0)).collect()
}

/// A swap under construction: what goes where, in both directions.
struct Swap<'a> {
    model: &'a Model,
    devices: BTreeMap<DeviceId, DeviceId>,
    resources: BTreeMap<ResourceId, ResourceId>,
    rules: BTreeMap<RuleId, RuleId>,
    /// Pairs still to be compared.
    open: Vec<(DeviceId, DeviceId)>,
}

/// No such swap exists.
struct Unlike;

impl<'a> Swap<'a> {
    /// The two smallest bundles that contain these devices and can change places. `None` if there
    /// are none, or if the devices are interchangeable by themselves.
    fn of(model: &'a Model, one: DeviceId, other: DeviceId) -> Option<(Bundle, Bundle)> {
        let mut swap = Self {
            model,
            devices: BTreeMap::new(),
            resources: BTreeMap::new(),
            rules: BTreeMap::new(),
            open: Vec::new(),
        };
        let mut firsts = BTreeSet::new();
        swap.pair(one, other).ok()?;
        while let Some((one, other)) = swap.open.pop() {
            firsts.insert(one);
            swap.compare(one, other).ok()?;
        }
        let pairs = || firsts.iter().filter_map(|one| Some((*one, *swap.devices.get(one)?)));
        let in_order = pairs().zip(pairs().skip(1)).all(|(a, b)| a.1 < b.1);
        if swap.resources.iter().all(|(r, s)| r == s) && swap.rules.iter().all(|(r, s)| r == s) {
            return None;
        }
        // The first device of each must be the one that was asked about: the tie-break relies on
        // it.
        if !in_order || firsts.first() != Some(&one) {
            return None;
        }
        let (mut first, mut second) = (Bundle::default(), Bundle::default());
        (first.devices, second.devices) = pairs().unzip();
        let owned = |rule: &RuleId| {
            model.rule_users[*rule].iter().any(|part| firsts.contains(&swap.device(*part)))
        };
        let moved = swap.rules.iter().filter(|(r, s)| r != s && owned(r));
        (first.rules, second.rules) = moved.map(|(r, s)| (*r, *s)).unzip();
        Some((first, second))
    }

    fn device(&self, part: Part) -> DeviceId {
        self.model.alt_device[self.model.part_alt(part)]
    }

    /// Records that the two change places, and compares them later.
    fn pair(&mut self, one: DeviceId, other: DeviceId) -> Result<(), Unlike> {
        match (self.devices.get(&one), self.devices.get(&other)) {
            (None, None) if one != other => {
                self.devices.extend([(one, other), (other, one)]);
                self.open.push((one, other));
                Ok(())
            }
            (Some(partner), Some(_)) if *partner == other => Ok(()),
            _ => Err(Unlike),
        }
    }

    fn compare(&mut self, one: DeviceId, other: DeviceId) -> Result<(), Unlike> {
        let model = self.model;
        let (a, b) = (model.alts.of(one), model.alts.of(other));
        let (p, q) = (model.roles.of_all(a), model.roles.of_all(b));
        let alike = model.roles.same_sizes(a, b)
            && model.cands.same_sizes(p, q)
            && model.alt_board.of(a) == model.alt_board.of(b)
            && model.alt_dma.equal(a, b);
        if !alike {
            return Err(Unlike);
        }
        let cands = model.cands.of_all(p).iter().zip(model.cands.of_all(q));
        cands.clone().try_for_each(|pair| self.compare_cands(pair))?;
        a.iter().zip(b).try_for_each(|pair| self.compare_alts(pair))
    }

    fn compare_cands(&mut self, (one, other): (CandId, CandId)) -> Result<(), Unlike> {
        let model = self.model;
        let (c, d) = (&model.cand[one], &model.cand[other]);
        if (c.place(), c.moved, c.extra) != (d.place(), d.moved, d.extra) {
            return Err(Unlike);
        }
        self.compare_claims(&model.cand_claims[one], &model.cand_claims[other])?;
        self.compare_rules(&model.cand_rules[one], &model.cand_rules[other])
    }

    fn compare_alts(&mut self, (one, other): (AltId, AltId)) -> Result<(), Unlike> {
        let model = self.model;
        self.compare_claims(&model.alt_claims[one], &model.alt_claims[other])?;
        self.compare_rules(&model.alt_rules[one], &model.alt_rules[other])
    }

    fn compare_claims(&mut self, one: &[Claim], other: &[Claim]) -> Result<(), Unlike> {
        if one.len() != other.len() {
            return Err(Unlike);
        }
        for (a, b) in one.iter().zip(other) {
            if a.holder != b.holder {
                return Err(Unlike);
            }
            if meet(&mut self.resources, a.resource, b.resource)? {
                let users = |r: ResourceId| -> BTreeSet<DeviceId> {
                    let users = self.model.resource_users[r].iter();
                    users.map(|(part, _)| self.device(*part)).collect()
                };
                self.pair_all(users(a.resource), users(b.resource))?;
            }
        }
        Ok(())
    }

    fn compare_rules(&mut self, one: &[RuleId], other: &[RuleId]) -> Result<(), Unlike> {
        if one.len() != other.len() {
            return Err(Unlike);
        }
        for (&a, &b) in one.iter().zip(other) {
            if meet(&mut self.rules, a, b)? {
                let users = |r: RuleId| -> BTreeSet<DeviceId> {
                    self.model.rule_users[r].iter().map(|part| self.device(*part)).collect()
                };
                self.pair_all(users(a), users(b))?;
            }
        }
        Ok(())
    }

    /// Pairs all users of one thing with all users of the other.
    fn pair_all(
        &mut self,
        ones: BTreeSet<DeviceId>,
        others: BTreeSet<DeviceId>,
    ) -> Result<(), Unlike> {
        if ones.len() != others.len() {
            return Err(Unlike);
        }
        ones.into_iter().zip(others).try_for_each(|(one, other)| self.pair(one, other))
    }
}

/// Records that two things change places, or that one stays. Returns whether they have just been
/// found to change places.
fn meet<T: Copy + Ord>(known: &mut BTreeMap<T, T>, one: T, other: T) -> Result<bool, Unlike> {
    match (known.get(&one), known.get(&other)) {
        (None, None) => {
            known.extend([(one, other), (other, one)]);
            Ok(one != other)
        }
        (Some(partner), Some(_)) if *partner == other => Ok(false),
        _ => Err(Unlike),
    }
}
