//! What the price bound prices: a model in, the things with prices and who is tied to them out.
//!
//! Pins, resources and DMA streams can be held once; a link ties a use to the opening of the
//! facility within which it happens.
#![expect(clippy::indexing_slicing, reason = "all indices are made here or come from the model")]

use crate::index::Rows;
use crate::model::{Kind, Model, NONE};
use crate::problem::Problem;
use std::collections::{BTreeMap, BTreeSet};

/// A price may be so many powers of two above the greatest weight: where there is no answer, the
/// price of one thing can pay for many.
const DEARER: u32 = 4;

/// What never changes: who is tied to which price.
#[derive(Clone, Debug, Default)]
pub(crate) struct Dualized {
    pub(crate) prices: usize,
    /// Prices count in weights times 2^shift.
    pub(crate) shift: u32,
    /// From here on prices are links: they bind a use to the opening of a facility.
    pub(crate) first_link: usize,
    pub(crate) first_stream: usize,
    /// Prices of an alternative and of a candidate, beside its pin.
    pub(crate) alt_prices: Rows<usize>,
    pub(crate) cand_prices: Rows<usize>,
    /// Streams (as prices) of each request of a user that belongs to the alternative alone.
    pub(crate) alt_requests: Vec<Vec<Vec<usize>>>,
    pub(crate) alt_facilities: Rows<usize>,
    pub(crate) facilities: Vec<Facility>,
    /// Facilities of which so many must be open together.
    pub(crate) families: Vec<Family>,
    /// Soft rules that more than one wire can violate.
    pub(crate) penalties: Vec<Penalty>,
}

/// A soft rule that is paid for once, by all who violate it together.
#[derive(Clone, Debug)]
pub(crate) struct Penalty {
    pub(crate) rule: usize,
    /// Price and how many links have it.
    pub(crate) links: Vec<(usize, i64)>,
}

/// The prices of links, numbered as they are found.
struct Links {
    next: usize,
    /// By the facility, and the resource or (from above) the class of devices.
    of_facility: BTreeMap<(usize, usize), usize>,
    /// By the rule, the class of devices, and the role's position or none.
    of_rule: BTreeMap<(usize, usize, usize), usize>,
}

impl Links {
    fn facility(&mut self, tied: usize, facility: usize) -> usize {
        let next = self.next;
        let link = *self.of_facility.entry((tied, facility)).or_insert(next);
        self.next += usize::from(link == next);
        link
    }

    fn rule(&mut self, rule: usize, class: usize, position: usize) -> usize {
        let next = self.next;
        let link = *self.of_rule.entry((rule, class, position)).or_insert(next);
        self.next += usize::from(link == next);
        link
    }
}

/// Something that is opened for all who use it together: a bus, a timer at one frequency.
#[derive(Clone, Debug, Default)]
pub(crate) struct Facility {
    /// Price of what it occupies.
    pub(crate) resource: Option<usize>,
    pub(crate) wires: Vec<usize>,
    /// Price and how many links have it.
    pub(crate) links: Vec<(usize, i64)>,
    pub(crate) requests: Vec<Vec<usize>>,
    pub(crate) alts: Vec<usize>,
}

#[derive(Clone, Debug, Default)]
pub(crate) struct Family {
    pub(crate) members: Vec<usize>,
    pub(crate) need: usize,
}

impl Dualized {
    pub(crate) fn new(problem: &Problem, model: &Model) -> Self {
        let first_stream = model.pins + model.resource_users.len();
        let first_link = first_stream + problem.streams as usize;
        let mut terms = Self { first_link, first_stream, ..Self::default() };
        let odd = odd_resources(problem, model);
        let of_alt = terms.find_facilities(model, &odd);
        let mut links =
            Links { next: first_link, of_facility: BTreeMap::new(), of_rule: BTreeMap::new() };
        for alt in 0..model.alt_device.len() {
            let mut price_all = |claims: &[(usize, usize)]| -> BTreeSet<usize> {
                let own = claims.iter().filter(|c| c.1 == 0 && !odd[c.0]).map(|c| c.0);
                own.map(|r| terms.price_of(model, r, &of_alt, alt, &mut links)).collect()
            };
            let mut own = price_all(model.alt_claims.at(alt));
            let mut of_cands = Vec::new();
            for role in model.roles.range(alt) {
                for id in model.cands.range(role) {
                    of_cands.push(price_all(model.cand_claims.at(id)));
                }
            }
            add_penalties(model, alt, &mut links, &mut own, &mut of_cands);
            // Links of channels do not bind alike devices together.
            for &facility in &of_alt[alt] {
                terms.alt_facilities.add(facility);
                let class = model.class[model.alt_device[alt]];
                own.insert(links.facility(usize::MAX - class, facility));
            }
            own.into_iter().for_each(|p| terms.alt_prices.add(p));
            terms.alt_prices.close();
            terms.alt_facilities.close();
            for prices in of_cands {
                prices.into_iter().for_each(|p| terms.cand_prices.add(p));
                terms.cand_prices.close();
            }
        }
        // Alike devices have one price together, but each its own link.
        let alike =
            |class: usize| model.class.iter().filter(|c| **c == class).count().max(1) as i64;
        for (&(tied, facility), &link) in &links.of_facility {
            terms.facilities[facility].links.push((link, alike(usize::MAX - tied)));
        }
        let mut penalties: BTreeMap<usize, Vec<(usize, i64)>> = BTreeMap::new();
        for (&(rule, class, _), &link) in &links.of_rule {
            penalties.entry(rule).or_default().push((link, alike(class)));
        }
        let penalty = |(rule, links)| Penalty { rule, links };
        terms.penalties = penalties.into_iter().map(penalty).collect();
        terms.prices = links.next;
        terms.shift = terms.find_shift(model);
        terms.find_requests(problem, model);
        terms.find_families(model);
        terms
    }

    /// As fine as it can be while all prices, none above [`Self::dearest`], still add up.
    fn find_shift(&self, model: &Model) -> u32 {
        let of_facilities = self.facilities.iter().flat_map(|f| &f.links);
        let links = of_facilities.chain(self.penalties.iter().flat_map(|p| &p.links));
        let times: i64 = links.map(|l| l.1).sum();
        let terms = self.prices as u64 + times.unsigned_abs() + model.devices as u64;
        let bits = (64 - model.most.leading_zeros()) + (64 - terms.leading_zeros());
        61_u32.saturating_sub(bits + DEARER).min(16)
    }

    /// The greatest price that counts.
    pub(crate) fn dearest(&self, model: &Model) -> u64 {
        model.most << (self.shift + DEARER)
    }

    /// Makes the facilities and tells those of each alternative.
    fn find_facilities(&mut self, model: &Model, odd: &[bool]) -> Vec<Vec<usize>> {
        let mut numbers: BTreeMap<(usize, usize), usize> = BTreeMap::new();
        let mut of_alt = vec![Vec::new(); model.alt_device.len()];
        let mut wire_keys: Vec<Option<BTreeSet<(usize, usize)>>> = vec![None; model.wires];
        let wires = |alt: usize| {
            model.roles.range(alt).filter_map(|role| match model.role_kind[role] {
                Kind::Wire(wire) => Some(wire),
                Kind::Own | Kind::Odd => None,
            })
        };
        // A wire belongs to a group when it is there whenever the group is.
        let mut group_size: BTreeMap<(usize, usize), usize> = BTreeMap::new();
        let mut wire_size = vec![0; model.wires];
        for alt in 0..model.alt_device.len() {
            let keys: BTreeSet<(usize, usize)> = model.alt_groups.at(alt).iter().copied().collect();
            for key in &keys {
                *group_size.entry(*key).or_default() += 1;
            }
            for wire in wires(alt) {
                wire_size[wire] += 1;
                wire_keys[wire] = Some(match wire_keys[wire].take() {
                    None => keys.clone(),
                    Some(old) => old.intersection(&keys).copied().collect(),
                });
            }
        }
        for (alt, own) in of_alt.iter_mut().enumerate() {
            let contested = model.alt_claims.at(alt).iter().filter(|c| c.1 != 0).copied();
            let mut keys: BTreeSet<(usize, usize)> = contested.collect();
            let key = |wire: usize| {
                let always = |k: &&(usize, usize)| group_size[*k] == wire_size[wire];
                let common = wire_keys[wire].iter().flatten().find(always).copied();
                common.unwrap_or((NONE, wire))
            };
            keys.extend(wires(alt).map(key));
            for k in keys {
                let next = numbers.len();
                let facility = *numbers.entry(k).or_insert(next);
                if facility == next {
                    let contested =
                        k.0 != NONE && !odd[k.0] && !model.resource_users.at(k.0).is_empty();
                    let resource = contested.then(|| model.pins + k.0);
                    self.facilities.push(Facility { resource, ..Facility::default() });
                }
                own.push(facility);
                self.facilities[facility].alts.push(alt);
                for wire in wires(alt).filter(|w| key(*w) == k) {
                    let list = &mut self.facilities[facility].wires;
                    if !list.contains(&wire) {
                        list.push(wire);
                    }
                }
            }
        }
        of_alt
    }

    fn price_of(
        &self,
        model: &Model,
        resource: usize,
        of_alt: &[Vec<usize>],
        alt: usize,
        links: &mut Links,
    ) -> usize {
        // Outputs of one channel at several frequencies: one link for each facility.
        let users = model.resource_users.at(resource);
        let own = |f: &usize| {
            users
                .iter()
                .all(|u| u.holder == 0 && self.excludes(model, *f, model.user_alt(u), of_alt))
        };
        match of_alt[alt].as_slice() {
            [facility] if own(facility) => links.facility(resource, *facility),
            _ => model.pins + resource,
        }
    }

    /// Whether who takes the alternative is within the facility or shuts it.
    fn excludes(&self, model: &Model, facility: usize, alt: usize, of_alt: &[Vec<usize>]) -> bool {
        match self.facilities[facility].resource {
            Some(price) => model.alt_claims.at(alt).iter().any(|c| model.pins + c.0 == price),
            None => of_alt[alt] == [facility],
        }
    }

    fn find_requests(&mut self, problem: &Problem, model: &Model) {
        self.alt_requests = vec![Vec::new(); model.alt_device.len()];
        if !model.dma_matters {
            return;
        }
        let mut users: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for alt in 0..model.alt_device.len() {
            for &user in model.alt_dma.at(alt) {
                users.entry(user).or_default().push(alt);
            }
        }
        for (user, alts) in users {
            let requests = problem.dma[user].requests.iter().map(|request| {
                request.streams.iter().map(|s| self.first_stream + s.0 as usize).collect()
            });
            let requests: Vec<Vec<usize>> = requests.collect();
            if model.user_private[user] {
                for &alt in &alts {
                    self.alt_requests[alt].extend(requests.iter().cloned());
                }
                continue;
            }
            // A bus pays for its streams when all on it use them, and nobody else at that time:
            // either there is nobody else, or all claim one resource.
            let whole = |f: &usize| self.facilities[*f].alts.iter().all(|a| alts.contains(a));
            let home = (0..self.facilities.len())
                .find(|f| self.facilities[*f].alts.len() == alts.len() && whole(f));
            if let Some(facility) = home {
                self.facilities[facility].requests.extend(requests);
            } else if let Some(resource) = common_resource(model, &alts) {
                let price = Some(model.pins + resource);
                let buses: Vec<usize> = (0..self.facilities.len())
                    .filter(|f| self.facilities[*f].resource == price && whole(f))
                    .collect();
                for facility in buses {
                    self.facilities[facility].requests.extend(requests.iter().cloned());
                }
                let own = |alt: &&usize| model.alt_claims.at(**alt).contains(&(resource, 0));
                for &alt in alts.iter().filter(own) {
                    self.alt_requests[alt].extend(requests.iter().cloned());
                }
            }
        }
    }

    /// Facilities that the same devices choose from, and how many they need at least.
    fn find_families(&mut self, model: &Model) {
        let mut family: Vec<usize> = (0..self.facilities.len()).collect();
        for device in 0..model.devices {
            let mut all = model.alts.range(device).flat_map(|alt| self.alt_facilities.at(alt));
            let Some(&first) = all.next() else { continue };
            let target = family[first];
            for &other in all {
                let old = family[other];
                family.iter_mut().filter(|f| **f == old).for_each(|f| *f = target);
            }
        }
        let mut devices: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for device in 0..model.devices {
            let mut alts = model.alts.range(device);
            let first = alts.start;
            if alts.all(|alt| self.alt_facilities.at(alt).len() == 1)
                && let Some(f) = self.alt_facilities.at(first).first()
            {
                devices.entry(family[*f]).or_default().push(device);
            }
        }
        for (number, devices) in devices {
            let of_family = (0..self.facilities.len()).filter(|f| family[*f] == number);
            let room = of_family.map(|f| (self.capacity(model, f).max(1), f)).collect();
            self.add_families(devices.len(), room);
        }
    }

    /// Where the small facilities have no room for all, so many of the greater ones must be open:
    /// a family for each size from which on there are more of them, each within the next.
    fn add_families(&mut self, devices: usize, mut room: Vec<(usize, usize)>) {
        room.sort_by_key(|&(room, facility)| (std::cmp::Reverse(room), facility));
        let mut last = 0;
        for number in 1..=room.len() {
            let (great, small) = room.split_at(number);
            let same = |(one, other): (&(usize, usize), &(usize, usize))| one.0 == other.0;
            if great.last().zip(small.first()).is_some_and(same) {
                continue;
            }
            let small = small.iter().fold(0_usize, |sum, s| sum.saturating_add(s.0));
            let mut left = devices.saturating_sub(small);
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
                self.families.push(Family { members, need });
            }
        }
    }

    /// Most devices that a facility can serve: as many as its links, and as many as there are pins
    /// for the first wire that each of them needs of its own.
    fn capacity(&self, model: &Model, facility: usize) -> usize {
        let facility = &self.facilities[facility];
        let link = |prices: &[usize]| facility.links.iter().find(|l| prices.contains(&l.0));
        let mut links: Option<BTreeSet<&(usize, i64)>> = Some(BTreeSet::new());
        let mut pins = Some(BTreeSet::new());
        for &alt in &facility.alts {
            let role = model.roles.range(alt).find(|r| model.role_kind[*r] == Kind::Own);
            let cands = role.map_or(0..0, |role| model.cands.range(role));
            match (&mut pins, role) {
                (Some(pins), Some(_)) => pins.extend(cands.clone().map(|id| model.cand(id).pin)),
                _ => pins = None,
            }
            let of_cands: Option<Vec<_>> = cands.map(|c| link(self.cand_prices.at(c))).collect();
            let found = match of_cands.filter(|links| !links.is_empty()) {
                Some(links) => Some(links),
                None => link(self.alt_prices.at(alt)).map(|own| vec![own]),
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

/// Ties an alternative and its candidates to the rules that they violate. A shared wire has no
/// prices of its own; it counts where all its candidates violate a rule.
fn add_penalties(
    model: &Model,
    alt: usize,
    links: &mut Links,
    own: &mut BTreeSet<usize>,
    of_cands: &mut [BTreeSet<usize>],
) {
    let class = model.class[model.alt_device[alt]];
    let general = |rules: &[usize]| -> Vec<usize> {
        rules.iter().copied().filter(|&rule| !model.rule_local[rule]).collect()
    };
    for rule in general(model.alt_rules.at(alt)) {
        own.insert(links.rule(rule, class, NONE));
    }
    let mut place = 0;
    for (position, role) in model.roles.range(alt).enumerate() {
        let mut cands = model.cands.range(role);
        if model.role_kind[role] == Kind::Own {
            for id in cands {
                for rule in general(model.cand_rules.at(id)) {
                    of_cands[place].insert(links.rule(rule, class, position));
                }
                place += 1;
            }
            continue;
        }
        place += cands.len();
        let first = cands.next().map_or(Vec::new(), |id| general(model.cand_rules.at(id)));
        for rule in first {
            if cands.clone().all(|id| model.cand_rules.at(id).contains(&rule)) {
                own.insert(links.rule(rule, class, NONE));
            }
        }
    }
}

/// A resource that all these alternatives claim.
fn common_resource(model: &Model, alts: &[usize]) -> Option<usize> {
    let (first, rest) = alts.split_first()?;
    let claims = |alt: usize, resource: usize| {
        model.alt_claims.at(alt).iter().any(|claim| claim.0 == resource)
    };
    let mut own = model.alt_claims.at(*first).iter().map(|claim| claim.0);
    own.find(|&r| rest.iter().all(|&alt| claims(alt, r)))
}

/// Resources that one device can claim in several places or for several holders at once: it does
/// not quarrel with itself, so no price counts them right.
fn odd_resources(problem: &Problem, model: &Model) -> Vec<bool> {
    let mut odd = vec![false; problem.resources as usize];
    for alt in 0..model.alt_device.len() {
        let mut seen: BTreeMap<usize, (usize, usize)> = BTreeMap::new();
        let mut book = |place: usize, claims: &[(usize, usize)]| {
            for &(resource, holder) in claims {
                let first = seen.entry(resource).or_insert((place, holder));
                // The tie of a shared wire has a holder for each pin and carries no price.
                let tie = first.1 != 0 && holder != 0 && place != NONE;
                odd[resource] |= *first != (place, holder) && !(tie && first.0 == place);
            }
        };
        book(NONE, model.alt_claims.at(alt));
        for role in model.roles.range(alt) {
            model.cands.range(role).for_each(|id| book(role, model.cand_claims.at(id)));
        }
    }
    odd
}
