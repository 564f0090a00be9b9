//! The second bound: prices on pins, resources, units and streams.
//!
//! Every thing that can be held once gets a price instead of a limit; then each group of alike
//! devices, and each shared unit, chooses for itself what is cheapest, and the sum less the prices
//! is a lower bound whatever the prices are. A subgradient ascent looks for good ones. Unlike the
//! flow, this bound sees that a device's wires come from one alternative, that a shared unit is
//! opened as a whole and that groups exclude each other. What would cost too much at the prices
//! found is struck from the domains. All arithmetic is in integers, so the bound is exact.
#![expect(clippy::indexing_slicing, reason = "all indices are made here or come from the model")]

use crate::model::{Kind, Model, NONE, Rows};
use crate::problem::Problem;
use crate::state::{Dead, State};
use std::collections::{BTreeMap, BTreeSet};

/// Prices count in weights times 2^SHIFT.
const SHIFT: u32 = 8;

/// More than any sum of costs ([`crate::answer::Fault::TooLarge`] sees to that).
const FAR: i64 = 1 << 54;

/// A bound from here on means that there is no answer.
pub(crate) const NEVER: u64 = 1 << 45;

/// What never changes: who is tied to which price.
#[derive(Clone, Debug, Default)]
pub(crate) struct Terms {
    prices: usize,
    /// From here on prices are links: they bind a use to the opening of a facility.
    first_link: usize,
    first_stream: usize,
    /// Prices of an alternative and of a candidate, beside its pin.
    alt_prices: Rows<usize>,
    cand_prices: Rows<usize>,
    /// Streams (as prices) of each request of a user that belongs to the alternative alone.
    alt_requests: Vec<Vec<Vec<usize>>>,
    alt_facilities: Rows<usize>,
    facilities: Vec<Facility>,
    /// Facilities of which so many must be open together.
    families: Vec<Family>,
}

/// Something that is opened for all who use it together: a bus, a timer at one frequency.
#[derive(Clone, Debug, Default)]
struct Facility {
    /// Price of what it occupies.
    resource: Option<usize>,
    wires: Vec<usize>,
    /// Price and how many links have it.
    links: Vec<(usize, i64)>,
    requests: Vec<Vec<usize>>,
    alts: Vec<usize>,
}

#[derive(Clone, Debug, Default)]
struct Family {
    members: Vec<usize>,
    need: usize,
}

impl Terms {
    pub(crate) fn new(problem: &Problem, model: &Model) -> Self {
        let first_stream = model.pins + model.resource_users.len();
        let first_link = first_stream + problem.streams as usize;
        let mut terms = Self { first_link, first_stream, ..Self::default() };
        let odd = odd_resources(problem, model);
        let of_alt = terms.find_facilities(model, &odd);
        let mut links: BTreeMap<(usize, usize), usize> = BTreeMap::new();
        for alt in 0..model.alt_device.len() {
            let mut price_all = |claims: &[(usize, usize)]| -> BTreeSet<usize> {
                let own = claims.iter().filter(|c| c.1 == 0 && !odd[c.0]).map(|c| c.0);
                own.map(|r| terms.price_of(model, r, &of_alt, alt, &mut links)).collect()
            };
            let mut own = price_all(model.alt_claims.at(alt));
            let mut linked = own.iter().any(|p| *p >= first_link);
            let mut of_cands = Vec::new();
            for role in model.roles.range(alt) {
                let mut inner = !model.cands.range(role).is_empty();
                for id in model.cands.range(role) {
                    let prices = price_all(model.cand_claims.at(id));
                    inner &= prices.iter().any(|p| *p >= first_link);
                    of_cands.push(prices);
                }
                linked |= inner;
            }
            for &facility in &of_alt[alt] {
                terms.alt_facilities.add(facility);
                if !(linked && of_alt[alt].len() == 1) {
                    let class = model.class[model.alt_device[alt]];
                    let key = (usize::MAX - class, facility);
                    let next = first_link + links.len();
                    own.insert(*links.entry(key).or_insert(next));
                }
            }
            own.into_iter().for_each(|p| terms.alt_prices.add(p));
            terms.alt_prices.close();
            terms.alt_facilities.close();
            for prices in of_cands {
                prices.into_iter().for_each(|p| terms.cand_prices.add(p));
                terms.cand_prices.close();
            }
        }
        for (&(of, facility), &link) in &links {
            // Alike devices have one price together, but each its own link.
            let alike = model.class.iter().filter(|c| usize::MAX - **c == of).count();
            terms.facilities[facility].links.push((link, alike.max(1) as i64));
        }
        terms.prices = first_link + links.len();
        terms.find_requests(problem, model);
        terms.find_families(model);
        terms
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
            let keys: BTreeSet<(usize, usize)> =
                model.alt_groups.at(alt).iter().copied().collect();
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
        for alt in 0..model.alt_device.len() {
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
                    let resource = contested.then_some(model.pins + k.0);
                    self.facilities.push(Facility { resource, ..Facility::default() });
                }
                of_alt[alt].push(facility);
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
        links: &mut BTreeMap<(usize, usize), usize>,
    ) -> usize {
        // Outputs of one channel at several frequencies: one link for each facility.
        let users = model.resource_users.at(resource);
        let facility = of_alt[alt].iter().copied().find(|_| {
            users.iter().all(|u| u.holder == 0 && of_alt[model.user_alt(u)].len() == 1)
        });
        match facility.filter(|f| self.same_resource(model, resource, *f, of_alt)) {
            Some(facility) => {
                let next = self.first_link + links.len();
                *links.entry((resource, facility)).or_insert(next)
            }
            None => model.pins + resource,
        }
    }

    /// Whether all facilities within which the resource is claimed exclude each other.
    fn same_resource(
        &self,
        model: &Model,
        resource: usize,
        facility: usize,
        of_alt: &[Vec<usize>],
    ) -> bool {
        let occupied = self.facilities[facility].resource;
        model.resource_users.at(resource).iter().all(|user| {
            of_alt[model.user_alt(user)].iter().all(|f| {
                *f == facility || (occupied.is_some() && self.facilities[*f].resource == occupied)
            })
        })
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
            // A bus pays for its streams when all who use them use the bus.
            let home = (0..self.facilities.len())
                .find(|&f| self.facilities[f].alts.iter().eq(alts.iter()));
            if let Some(facility) = home {
                self.facilities[facility].requests.extend(requests);
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
            if alts.all(|alt| self.alt_facilities.at(alt).len() == 1) {
                if let Some(f) = self.alt_facilities.at(first).first() {
                    devices.entry(family[*f]).or_default().push(device);
                }
            }
        }
        for (number, devices) in devices {
            let members: Vec<usize> =
                (0..self.facilities.len()).filter(|f| family[*f] == number).collect();
            let most = members.iter().map(|&f| self.capacity(model, f)).max().unwrap_or(1).max(1);
            self.families.push(Family { need: devices.len().div_ceil(most), members });
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
            let found = match link(self.alt_prices.at(alt)) {
                Some(own) => Some(vec![own]),
                None => of_cands.filter(|links| !links.is_empty()),
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

/// Several ways to fill a role, or a DMA request: a price each, and a fixed cost.
#[derive(Clone, Copy, Debug)]
struct Way {
    id: usize,
    /// Pin or stream.
    price: usize,
    fixed: i64,
    /// More prices, as a range of `View::lists`.
    more: (usize, usize),
}

#[derive(Clone, Copy, Debug)]
struct Choice {
    alt: usize,
    prices: (usize, usize),
    roles: (usize, usize),
    cost: i64,
    once: bool,
}

#[derive(Clone, Debug)]
struct Group {
    devices: Vec<usize>,
    choices: (usize, usize),
    /// Every way of the only role can be taken once.
    spread: bool,
}

#[derive(Clone, Debug)]
struct Opening {
    facility: usize,
    roles: (usize, usize),
    forced: bool,
    cost: i64,
    open: bool,
    /// What its opening would save elsewhere: another one opened only for the number's sake.
    spares: i64,
}

/// The domains of one node in a form that is quick to price.
#[derive(Clone, Debug, Default)]
struct View {
    groups: Vec<Group>,
    choices: Vec<Choice>,
    /// Ranges of `ways`.
    roles: Vec<(usize, usize)>,
    ways: Vec<Way>,
    lists: Vec<usize>,
    openings: Vec<Opening>,
    /// Cheapest way of each role at the present prices.
    cheapest: Vec<(i64, usize)>,
    /// Dearest choice that some device of the group takes.
    margin: Vec<i64>,
    order: Vec<(i64, usize, usize)>,
}

/// Prices and the work space of the ascent.
#[derive(Clone, Debug)]
pub(crate) struct Dual {
    prices: Vec<i64>,
    best: Vec<i64>,
    slope: Vec<i64>,
    drift: Vec<i64>,
    view: View,
    opening_of: Vec<usize>,
    /// Least bound of what was struck.
    pub(crate) struck: u64,
}

impl Dual {
    pub(crate) fn new(terms: &Terms) -> Self {
        Self {
            prices: vec![0; terms.prices],
            best: vec![0; terms.prices],
            slope: vec![0; terms.prices],
            drift: vec![0; terms.prices],
            view: View::default(),
            opening_of: Vec::new(),
            struck: u64::MAX,
        }
    }

    pub(crate) fn save(&self) -> Vec<i64> {
        self.prices.clone()
    }

    pub(crate) fn restore(&mut self, saved: &[i64]) {
        self.prices.copy_from_slice(saved);
    }

    /// Improves the prices for some steps and returns the bound, which counts everything.
    pub(crate) fn ascend(
        &mut self,
        terms: &Terms,
        model: &Model,
        state: &State,
        limit: u64,
        steps: usize,
    ) -> u64 {
        self.build(terms, model, state);
        let paid = (state.paid as i64) << SHIFT;
        let known = limit < u64::MAX;
        let unit = (model.weights.cost as i64) << SHIFT;
        let mut best = i64::MIN;
        let (mut pace, mut idle) = (256, 0);
        self.drift.fill(0);
        for step in 0..=steps {
            let value = self.evaluate(terms, model) + paid;
            if value > best {
                // Small gains count as none: the pace is what is wrong.
                idle = if value > best + unit / 64 { 0 } else { idle + 1 };
                best = value;
                self.best.copy_from_slice(&self.prices);
            } else {
                idle += 1;
            }
            if idle >= 8 {
                (pace, idle) = (pace / 2, 0);
                self.prices.copy_from_slice(&self.best);
            }
            let target = if known { (limit as i64) << SHIFT } else { best + best / 16 + unit };
            if known && value >= target || step == steps || pace < 4 {
                break;
            }
            self.step(terms, (target - value).max(unit / 8), pace);
        }
        self.prices.copy_from_slice(&self.best);
        let value = self.evaluate(terms, model) + paid;
        value.max(0).unsigned_abs().div_ceil(1 << SHIFT)
    }

    /// The alternative that is cheapest for a device at the last prices.
    pub(crate) fn cheapest(&self, model: &Model, device: usize) -> Option<usize> {
        let group = self.view.groups.iter().find(|g| g.devices.contains(&device))?;
        let choices = &self.view.choices[group.choices.0..group.choices.1];
        let best = choices.iter().min_by_key(|c| c.cost)?;
        let first = model.alts.range(group.devices[0]).start;
        Some(best.alt - first + model.alts.range(device).start)
    }

    /// Moves the prices along the slope, with some of the last move in it.
    fn step(&mut self, terms: &Terms, gap: i64, pace: i64) {
        let mut norm = 0;
        for ((drift, slope), price) in self.drift.iter_mut().zip(&self.slope).zip(&self.prices) {
            *drift = slope * 16 + *drift * 5 / 8;
            if *price == 0 && *drift < 0 {
                *drift = 0;
            }
            norm += *drift * *drift;
        }
        if norm == 0 {
            return;
        }
        debug_assert_eq!(terms.prices, self.prices.len());
        for (price, drift) in self.prices.iter_mut().zip(&self.drift) {
            if *drift != 0 {
                let move_by = i128::from(gap) * i128::from(pace * drift) / i128::from(16 * norm);
                *price = (*price + move_by as i64).max(0);
            }
        }
    }

    /// Strikes what no answer below the limit can use. Returns whether anything was struck;
    /// `struck` then bounds what is gone.
    pub(crate) fn strike(
        &mut self,
        terms: &Terms,
        model: &Model,
        state: &mut State,
        bound: u64,
        limit: u64,
    ) -> Result<bool, Dead> {
        self.struck = u64::MAX;
        if limit == u64::MAX || bound >= limit {
            return Ok(false);
        }
        let value = self.evaluate(terms, model) + ((state.paid as i64) << SHIFT);
        // An answer of weight limit - 1 must survive.
        let room = ((limit as i64 - 1) << SHIFT) - value;
        let mark = state.mark();
        let mut least = i64::MAX;
        let result = self
            .strike_groups(model, state, room, &mut least)
            .and_then(|()| self.strike_openings(terms, model, state, room, &mut least));
        if least < FAR {
            self.struck = (value + least).unsigned_abs().div_ceil(1 << SHIFT);
        }
        result.map(|()| state.mark() > mark)
    }

    fn strike_groups(
        &self,
        model: &Model,
        state: &mut State,
        room: i64,
        least: &mut i64,
    ) -> Result<(), Dead> {
        for (index, group) in self.view.groups.iter().enumerate() {
            let margin = self.view.margin[index];
            for choice in &self.view.choices[group.choices.0..group.choices.1] {
                let over = if group.spread && !choice.once {
                    // Each way stands for itself.
                    choice.cost - self.view.cheapest[choice.roles.0].0 - margin
                } else {
                    (choice.cost - margin).max(0)
                };
                let first = model.alts.range(group.devices[0]).start;
                if !(group.spread && !choice.once) && over > room {
                    *least = over.min(*least);
                    for &device in &group.devices {
                        let start = model.alts.range(device).start;
                        state.kill_alt(model, start + choice.alt - first)?;
                    }
                    continue;
                }
                for role in choice.roles.0..choice.roles.1 {
                    let cheapest = self.view.cheapest[role].0;
                    for way in self.ways(role) {
                        if way.id == NONE {
                            continue;
                        }
                        let cost = self.way_cost(way);
                        let extra = if group.spread && !choice.once {
                            (over + cost).max(0)
                        } else {
                            over + cost - cheapest
                        };
                        if extra > room {
                            *least = extra.min(*least);
                            for &device in &group.devices {
                                let twin = twin_cand(model, group.devices[0], device, way.id);
                                state.kill_cand(model, twin)?;
                            }
                        }
                    }
                }
            }
        }
        Ok(())
    }

    fn strike_openings(
        &self,
        terms: &Terms,
        model: &Model,
        state: &mut State,
        room: i64,
        least: &mut i64,
    ) -> Result<(), Dead> {
        for opening in &self.view.openings {
            let over = if opening.open { 0 } else { (opening.cost - opening.spares).max(0) };
            if over > room {
                *least = over.min(*least);
                for &alt in &terms.facilities[opening.facility].alts {
                    state.kill_alt(model, alt)?;
                }
                continue;
            }
            for role in opening.roles.0..opening.roles.1 {
                let cheapest = self.view.cheapest[role].0;
                for way in self.ways(role) {
                    let extra = over + self.way_cost(way) - cheapest;
                    if way.id == NONE || extra <= room {
                        continue;
                    }
                    *least = extra.min(*least);
                    let c = model.cand(way.id);
                    let Kind::Wire(wire) = model.role_kind[c.role] else { continue };
                    for &other in model.wire_cands.at(wire) {
                        let o = model.cand(other);
                        if (o.pin, o.signal, o.holder) == (c.pin, c.signal, c.holder) {
                            state.kill_cand(model, other)?;
                        }
                    }
                }
            }
        }
        Ok(())
    }

    fn ways(&self, role: usize) -> &[Way] {
        let (start, end) = self.view.roles[role];
        &self.view.ways[start..end]
    }

    fn way_cost(&self, way: &Way) -> i64 {
        let more = &self.view.lists[way.more.0..way.more.1];
        way.fixed + self.prices[way.price] + more.iter().map(|&p| self.prices[p]).sum::<i64>()
    }

    /// The bound at the present prices (without what is paid); sets the slope.
    fn evaluate(&mut self, terms: &Terms, model: &Model) -> i64 {
        for role in 0..self.view.roles.len() {
            let (start, end) = self.view.roles[role];
            let mut best = (FAR, NONE);
            for index in start..end {
                let cost = self.way_cost(&self.view.ways[index]);
                if cost < best.0 {
                    best = (cost, index);
                }
            }
            self.view.cheapest[role] = best;
        }
        for slope in &mut self.slope[..terms.first_link] {
            *slope = -1;
        }
        self.slope[terms.first_link..].fill(0);
        let mut value = -self.prices[..terms.first_link].iter().sum::<i64>();
        for index in 0..self.view.groups.len() {
            value += self.choose(index);
        }
        value += self.open(terms);
        debug_assert_eq!(model.alt_device.len(), terms.alt_requests.len());
        value
    }

    /// A group of alike devices takes the cheapest that it can take together.
    fn choose(&mut self, index: usize) -> i64 {
        let (start, end) = self.view.groups[index].choices;
        let number = self.view.groups[index].devices.len();
        let spread = self.view.groups[index].spread;
        let mut order = std::mem::take(&mut self.view.order);
        order.clear();
        for c in start..end {
            let choice = self.view.choices[c];
            let own = &self.view.lists[choice.prices.0..choice.prices.1];
            let own: i64 = own.iter().map(|&p| self.prices[p]).sum();
            let roles = &self.view.cheapest[choice.roles.0..choice.roles.1];
            let cost = own + roles.iter().map(|r| r.0).sum::<i64>();
            self.view.choices[c].cost = cost;
            if spread && !choice.once {
                let (first, last) = self.view.roles[choice.roles.0];
                for way in first..last {
                    order.push((own + self.way_cost(&self.view.ways[way]), c, way));
                }
            } else {
                order.push((cost, c, NONE));
            }
        }
        let mut value = 0;
        let mut margin = FAR;
        if number == 1 {
            if let Some(&(cost, c, way)) = order.iter().min() {
                (value, margin) = (cost, cost);
                self.take(c, way, 1);
            }
        } else {
            order.sort_unstable();
            let mut left = number;
            for &(cost, c, way) in &order {
                let choice = self.view.choices[c];
                let times = if spread || choice.once { 1 } else { left };
                value += cost * times as i64;
                margin = cost;
                self.take(c, way, times as i64);
                left -= times;
                if left == 0 {
                    break;
                }
            }
            if left > 0 {
                // Fewer ways than devices: nothing fits.
                value = FAR;
            }
        }
        self.view.margin[index] = margin;
        self.view.order = order;
        value
    }

    /// Books what a choice uses.
    fn take(&mut self, c: usize, way: usize, times: i64) {
        let choice = self.view.choices[c];
        for &price in &self.view.lists[choice.prices.0..choice.prices.1] {
            self.slope[price] += times;
        }
        for role in choice.roles.0..choice.roles.1 {
            let way = if way == NONE { self.view.cheapest[role].1 } else { way };
            self.use_way(way, times);
        }
    }

    fn use_way(&mut self, way: usize, times: i64) {
        if way == NONE {
            return;
        }
        let way = self.view.ways[way];
        self.slope[way.price] += times;
        for &price in &self.view.lists[way.more.0..way.more.1] {
            self.slope[price] += times;
        }
    }

    /// Facilities open where that pays, and as many as their families need.
    fn open(&mut self, terms: &Terms) -> i64 {
        for index in 0..self.view.openings.len() {
            let (facility, roles) =
                (self.view.openings[index].facility, self.view.openings[index].roles);
            let facility = &terms.facilities[facility];
            let mut cost = facility.resource.map_or(0, |r| self.prices[r]);
            cost -= facility.links.iter().map(|&(l, times)| self.prices[l] * times).sum::<i64>();
            cost += self.view.cheapest[roles.0..roles.1].iter().map(|r| r.0).sum::<i64>();
            let opening = &mut self.view.openings[index];
            opening.cost = cost;
            opening.open = opening.forced || cost < 0;
            opening.spares = 0;
        }
        for family in &terms.families {
            let open = |f: &&usize| {
                let index = self.opening_of[**f];
                index != NONE && self.view.openings[index].open
            };
            let mut missing = family.need.saturating_sub(family.members.iter().filter(open).count());
            let mut dearest = 0;
            while missing > 0 {
                let shut = family.members.iter().map(|&f| self.opening_of[f]);
                let shut = shut.filter(|&i| i != NONE && !self.view.openings[i].open);
                let Some(next) = shut.min_by_key(|&i| self.view.openings[i].cost) else { break };
                self.view.openings[next].open = true;
                dearest = self.view.openings[next].cost.max(dearest);
                missing -= 1;
            }
            for &member in family.members.iter().filter(|_| dearest > 0) {
                if let Some(opening) = self.view.openings.get_mut(self.opening_of[member]) {
                    opening.spares = dearest;
                }
            }
        }
        let mut value = 0;
        for index in 0..self.view.openings.len() {
            if !self.view.openings[index].open {
                continue;
            }
            let roles = self.view.openings[index].roles;
            let facility = &terms.facilities[self.view.openings[index].facility];
            value += self.view.openings[index].cost;
            if let Some(resource) = facility.resource {
                self.slope[resource] += 1;
            }
            for &(link, times) in &facility.links {
                self.slope[link] -= times;
            }
            for role in roles.0..roles.1 {
                self.use_way(self.view.cheapest[role].1, 1);
            }
        }
        value
    }

    /// Brings the living domains into the view.
    fn build(&mut self, terms: &Terms, model: &Model, state: &State) {
        let view = &mut self.view;
        view.groups.clear();
        view.choices.clear();
        view.roles.clear();
        view.ways.clear();
        view.lists.clear();
        view.openings.clear();
        let mut done = vec![false; model.devices];
        for device in 0..model.devices {
            if done[device] {
                continue;
            }
            let devices: Vec<usize> = (device..model.devices)
                .filter(|&d| {
                    model.class[d] == model.class[device]
                        && (d == device || state.same_domain(model, device, d))
                })
                .collect();
            devices.iter().for_each(|&d| done[d] = true);
            let start = view.choices.len();
            for alt in state.alts(model, device) {
                view.add_choice(terms, model, state, alt);
            }
            let single = view.choices[start..].iter().all(|c| c.roles.1 - c.roles.0 == 1);
            let choices = (start, view.choices.len());
            view.groups.push(Group { spread: single && devices.len() > 1, devices, choices });
        }
        self.opening_of.clear();
        self.opening_of.resize(terms.facilities.len(), NONE);
        for (index, facility) in terms.facilities.iter().enumerate() {
            if facility.alts.iter().any(|&alt| state.alt_on(alt)) {
                self.opening_of[index] = self.view.openings.len();
                self.view.add_opening(model, state, index, facility);
            }
        }
        self.view.cheapest.clear();
        self.view.cheapest.resize(self.view.roles.len(), (0, NONE));
        self.view.margin.clear();
        self.view.margin.resize(self.view.groups.len(), 0);
    }
}

impl View {
    fn add_way(&mut self, model: &Model, more: &[usize], id: usize) {
        let start = self.lists.len();
        self.lists.extend_from_slice(more);
        let c = model.cand(id);
        self.ways.push(Way {
            id,
            price: c.pin,
            fixed: ((c.extra + model.pin_weight[c.pin]) as i64) << SHIFT,
            more: (start, self.lists.len()),
        });
    }

    fn add_requests(&mut self, requests: &[Vec<usize>]) {
        for request in requests {
            let start = self.ways.len();
            for &price in request {
                self.ways.push(Way { id: NONE, price, fixed: 0, more: (0, 0) });
            }
            self.roles.push((start, self.ways.len()));
        }
    }

    fn add_choice(&mut self, terms: &Terms, model: &Model, state: &State, alt: usize) {
        let prices = self.lists.len();
        self.lists.extend_from_slice(terms.alt_prices.at(alt));
        let prices = (prices, self.lists.len());
        let roles = self.roles.len();
        for role in model.roles.range(alt) {
            if model.role_kind[role] != Kind::Own {
                continue;
            }
            let start = self.ways.len();
            for id in state.cands(model, role) {
                self.add_way(model, terms.cand_prices.at(id), id);
            }
            self.roles.push((start, self.ways.len()));
        }
        self.add_requests(&terms.alt_requests[alt]);
        self.choices.push(Choice {
            alt,
            prices,
            roles: (roles, self.roles.len()),
            cost: 0,
            once: model.alt_claims.at(alt).iter().any(|c| c.1 == 0),
        });
    }

    fn add_opening(&mut self, model: &Model, state: &State, index: usize, facility: &Facility) {
        let roles = self.roles.len();
        let decided = facility
            .alts
            .iter()
            .find(|&&alt| state.decided(model.alt_device[alt]) == Some(alt));
        for &wire in &facility.wires {
            let start = self.ways.len();
            let mut seen = BTreeSet::new();
            for &id in model.wire_cands.at(wire) {
                let c = model.cand(id);
                let here = decided.is_none_or(|&alt| model.role_alt[c.role] == alt);
                if here && state.cand_on(model, id) && seen.insert((c.pin, c.signal, c.holder)) {
                    self.add_way(model, &[], id);
                }
            }
            self.roles.push((start, self.ways.len()));
        }
        self.add_requests(&facility.requests);
        self.openings.push(Opening {
            facility: index,
            roles: (roles, self.roles.len()),
            forced: decided.is_some(),
            cost: 0,
            open: false,
            spares: 0,
        });
    }
}

/// The candidate of an alike device that stands where this one does.
fn twin_cand(model: &Model, one: usize, other: usize, id: usize) -> usize {
    let first = |device: usize| {
        let role = model.roles.range(model.alts.range(device).start).start;
        model.cands.range(role).start
    };
    id - first(one) + first(other)
}
