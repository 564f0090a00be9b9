//! Facilities: finds everything in a model that is opened once for all its users, with the wires
//! and DMA streams that the opening costs.

use super::{Dualized, Link, Request};
use crate::index::{AltId, FacilityId, IdVec, PriceId, WireId};
use crate::model::Model;
use crate::problem::{Claim, DmaUserId, Holder, Problem, ResourceId};
use std::collections::{BTreeMap, BTreeSet};

/// Something that is opened for all who use it together: a bus, a timer at one frequency.
#[derive(Clone, Debug, Default)]
pub(crate) struct Facility {
    /// Price of the resource that it occupies.
    pub(crate) resource: Option<PriceId>,
    pub(crate) wires: Vec<WireId>,
    pub(crate) links: Vec<Link>,
    pub(crate) requests: Vec<Request>,
    /// The DMA users whose requests these are.
    pub(crate) users: Vec<DmaUserId>,
    /// The alternatives that use the facility.
    pub(crate) alts: Vec<AltId>,
}

/// The origin of a facility.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Key {
    /// A resource held by a group.
    Group(Claim),
    /// A shared wire that belongs to no group.
    Wire(WireId),
}

impl Dualized {
    /// Makes the facilities and returns those of each alternative.
    pub(super) fn find_facilities(
        &mut self,
        model: &Model,
        irregular: &IdVec<ResourceId, bool>,
    ) -> IdVec<AltId, Vec<FacilityId>> {
        let of_wire = wire_keys(model);
        let mut numbers: BTreeMap<Key, FacilityId> = BTreeMap::new();
        let mut of_alt = IdVec::same(Vec::new(), model.alt_device.len());
        for alt in model.alt_device.ids() {
            let contested = model.alt_claims[alt].iter().filter(|c| c.holder != Holder::Own);
            let mut keys: BTreeSet<Key> = contested.map(|claim| Key::Group(*claim)).collect();
            keys.extend(model.alt_wires(alt).map(|wire| of_wire[wire]));
            for key in keys {
                let facility = *numbers.entry(key).or_insert_with(|| {
                    let resource = match key {
                        Key::Group(claim) => Some(claim.resource),
                        Key::Wire(_) => None,
                    };
                    let contested =
                        |r: &ResourceId| !irregular[*r] && !model.resource_users[*r].is_empty();
                    let resource = resource.filter(contested).map(|r| self.resource(r));
                    self.facilities.push(Facility { resource, ..Facility::default() })
                });
                of_alt[alt].push(facility);
                let facility = &mut self.facilities[facility];
                facility.alts.push(alt);
                for wire in model.alt_wires(alt).filter(|&wire| of_wire[wire] == key) {
                    if !facility.wires.contains(&wire) {
                        facility.wires.push(wire);
                    }
                }
            }
        }
        of_alt
    }

    /// Gives the requests of each DMA user to the facility, or the alternatives, that they serve.
    pub(super) fn find_requests(&mut self, problem: &Problem, model: &Model) {
        self.alt_requests = IdVec::same(Vec::new(), model.alt_device.len());
        if !model.dma_matters {
            return;
        }
        let mut users: BTreeMap<DmaUserId, Vec<AltId>> = BTreeMap::new();
        for alt in model.alt_device.ids() {
            for &user in &model.alt_dma[alt] {
                users.entry(user).or_default().push(alt);
            }
        }
        for (user, alts) in users {
            let requests = problem.dma_user(user).requests.iter();
            let requests: Vec<Request> = requests
                .map(|request| request.streams.iter().map(|&s| self.stream(s)).collect())
                .collect();
            if model.user_private[user] {
                for &alt in &alts {
                    self.alt_requests[alt].extend(requests.iter().cloned());
                }
                continue;
            }
            self.add_shared_requests(model, user, &alts, &requests);
        }
    }

    /// A bus pays for its streams if every device on it uses them and no other device does so at
    /// the same time. That is the case if there is no other user, or if all users claim one
    /// resource.
    fn add_shared_requests(
        &mut self,
        model: &Model,
        user: DmaUserId,
        alts: &[AltId],
        requests: &[Request],
    ) {
        let whole = |f: &Facility| f.alts.iter().all(|alt| alts.contains(alt));
        let only = |f: &&mut Facility| f.alts.len() == alts.len() && whole(f);
        if let Some(facility) = self.facilities.iter_mut().find(only) {
            facility.requests.extend(requests.iter().cloned());
            facility.users.push(user);
        } else if let Some(resource) = common_resource(model, alts) {
            let price = Some(self.resource(resource));
            for facility in &mut self.facilities {
                if facility.resource == price && whole(facility) {
                    facility.requests.extend(requests.iter().cloned());
                    facility.users.push(user);
                }
            }
            let own = Claim { resource, holder: Holder::Own };
            for &alt in alts.iter().filter(|&&alt| model.alt_claims[alt].contains(&own)) {
                self.alt_requests[alt].extend(requests.iter().cloned());
            }
        }
    }
}

/// The facility of each shared wire: that of a group that is present whenever the wire is, or one
/// of the wire's own.
fn wire_keys(model: &Model) -> IdVec<WireId, Key> {
    let mut common: IdVec<WireId, Option<BTreeSet<Claim>>> = IdVec::same(None, model.wires.len());
    let mut group_size: BTreeMap<Claim, usize> = BTreeMap::new();
    let mut wire_size = IdVec::same(0, model.wires.len());
    for alt in model.alt_device.ids() {
        let groups: BTreeSet<Claim> = model.alt_groups[alt].iter().copied().collect();
        for group in &groups {
            *group_size.entry(*group).or_default() += 1;
        }
        for wire in model.alt_wires(alt) {
            wire_size[wire] += 1;
            common[wire] = Some(match common[wire].take() {
                None => groups.clone(),
                Some(old) => old.intersection(&groups).copied().collect(),
            });
        }
    }
    let key = |wire: WireId| {
        let always = |group: &&Claim| group_size.get(group) == Some(&wire_size[wire]);
        let group = common[wire].iter().flatten().find(always);
        group.map_or(Key::Wire(wire), |group| Key::Group(*group))
    };
    model.wires.iter().map(key).collect()
}

/// A resource that all these alternatives claim.
fn common_resource(model: &Model, alts: &[AltId]) -> Option<ResourceId> {
    let (first, rest) = alts.split_first()?;
    let claims = |alt: AltId, resource: ResourceId| {
        model.alt_claims[alt].iter().any(|claim| claim.resource == resource)
    };
    let mut own = model.alt_claims[*first].iter().map(|claim| claim.resource);
    own.find(|&r| rest.iter().all(|&alt| claims(alt, r)))
}
