//! The constraints that the Lagrangian bound dualizes: finds everything in a model that has a
//! price, and whatever is tied to it.
//!
//! Pins, resources and DMA streams can be held only once, so each has a price. The rest has the
//! structure of facility location (G. Cornuéjols, G. L. Nemhauser and L. A. Wolsey, *The
//! uncapacitated facility location problem*, 1990): a bus, or a timer at one frequency, is opened
//! once for all devices that use it. A link ties a use to that opening, and has a price too. If a
//! proof takes long, look here first for a missing constraint.

mod covers;
mod facilities;

pub(crate) use self::covers::Cover;
pub(crate) use self::facilities::Facility;

use crate::index::{AltId, CandId, FacilityId, Id, IdVec, Ids, PenaltyId, PriceId, Rows};
use crate::model::{Holding, Model};
use crate::problem::{Claim, DeviceId, Holder, PinId, Problem, ResourceId, RuleId, StreamId};
use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet};

/// Prices may exceed the greatest weight by this many powers of two. If there is no answer, one pin
/// may have to pay for many devices.
const DEARER: u32 = 4;

/// A link's price, and how many devices have a link with that price.
pub(crate) type Link = (PriceId, i64);

/// The streams, as prices, that can serve one request.
pub(crate) type Request = Vec<PriceId>;

/// The fixed part of the bound: which choices are tied to which prices.
#[derive(Clone, Debug, Default)]
pub(crate) struct Dualized {
    /// All prices: of pins, of resources, of streams, of links.
    pub(crate) prices: Ids<PriceId>,
    /// Prices of things that can be held only once. The others are prices of links.
    pub(crate) held: Ids<PriceId>,
    first_resource: usize,
    first_stream: usize,
    /// Prices are weights times 2^shift.
    pub(crate) shift: u32,
    /// Prices of an alternative and of a candidate, except that of its pin.
    pub(crate) alt_prices: Rows<AltId, PriceId>,
    pub(crate) cand_prices: Rows<CandId, PriceId>,
    /// Requests of DMA users that belong to the alternative alone.
    pub(crate) alt_requests: IdVec<AltId, Vec<Request>>,
    pub(crate) alt_facilities: Rows<AltId, FacilityId>,
    pub(crate) facilities: IdVec<FacilityId, Facility>,
    /// Sets of facilities of which a minimum number must be open.
    pub(crate) covers: Vec<Cover>,
    /// Soft rules that more than one wire can violate.
    pub(crate) penalties: IdVec<PenaltyId, Penalty>,
    /// The two things that each link ties together.
    pub(crate) ties: Vec<(PriceId, Tie)>,
}

/// A soft rule that is paid for once, by all that violate it together.
#[derive(Clone, Debug)]
pub(crate) struct Penalty {
    pub(crate) rule: RuleId,
    pub(crate) links: Vec<Link>,
}

/// The two things that a link ties together.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Tie {
    /// A device that claims the resource for itself pays the facility.
    Ticket(FacilityId, ResourceId),
    /// Each device of the class pays the facility.
    Link(FacilityId, DeviceId),
    /// Each device of the class pays for the rule: as a whole (0) or by a role (1 and up).
    Rule(RuleId, DeviceId, usize),
}

/// The thing that a link ties to a facility.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Tied {
    /// Any device that claims the resource.
    Resource(ResourceId),
    /// Each device of a class.
    Class(Reverse<DeviceId>),
}

/// The thing that a link ties to a rule.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Place {
    /// The role at this position.
    Role(usize),
    /// The alternative as a whole.
    Alternative,
}

/// The prices of links, numbered as they are found.
struct Links {
    next: usize,
    of_facility: BTreeMap<(Tied, FacilityId), PriceId>,
    /// Keyed by the rule, the class of devices, and the place.
    of_rule: BTreeMap<(RuleId, DeviceId, Place), PriceId>,
}

impl Links {
    fn facility(&mut self, tied: Tied, facility: FacilityId) -> PriceId {
        let next = PriceId::new(self.next);
        let link = *self.of_facility.entry((tied, facility)).or_insert(next);
        self.next += usize::from(link == next);
        link
    }

    fn rule(&mut self, rule: RuleId, class: DeviceId, place: Place) -> PriceId {
        let next = PriceId::new(self.next);
        let link = *self.of_rule.entry((rule, class, place)).or_insert(next);
        self.next += usize::from(link == next);
        link
    }
}

/// The prices of one alternative: its own, and those of its candidates in order.
struct AltPrices {
    own: BTreeSet<PriceId>,
    of_cands: Vec<BTreeSet<PriceId>>,
}

impl Dualized {
    pub(crate) fn new(problem: &Problem, model: &Model) -> Self {
        let first_resource = model.pins.len();
        let first_stream = first_resource + model.resource_users.len();
        let first_link = first_stream + problem.streams as usize;
        let held = Ids::first(first_link);
        let mut dualized = Self { first_resource, first_stream, held, ..Self::default() };
        let irregular = irregular_resources(problem, model);
        let of_alt = dualized.find_facilities(model, &irregular);
        let mut links =
            Links { next: first_link, of_facility: BTreeMap::new(), of_rule: BTreeMap::new() };
        for alt in model.alt_device.ids() {
            let mut prices = dualized.alt_prices(model, alt, &of_alt, &irregular, &mut links);
            add_penalties(model, alt, &mut links, &mut prices);
            // Links of channels do not bind interchangeable devices together.
            let class = Tied::Class(Reverse(model.class[model.alt_device[alt]]));
            prices.own.extend(of_alt[alt].iter().map(|&f| links.facility(class, f)));
            dualized.alt_facilities.push(of_alt[alt].iter().copied());
            dualized.alt_prices.push(prices.own);
            for of_cand in prices.of_cands {
                dualized.cand_prices.push(of_cand);
            }
        }
        dualized.add_links(model, &links);
        dualized.prices = Ids::first(links.next);
        dualized.shift = dualized.find_shift(model);
        dualized.find_requests(problem, model);
        dualized.find_covers(model);
        dualized
    }

    pub(crate) fn pin(pin: PinId) -> PriceId {
        PriceId(pin.0)
    }

    /// Whether it is the price of a link.
    pub(crate) fn is_link(&self, price: PriceId) -> bool {
        price.index() >= self.held.len()
    }

    /// The resource of a price.
    pub(crate) fn resource_of(&self, price: PriceId) -> ResourceId {
        ResourceId::new(price.index().saturating_sub(self.first_resource))
    }

    /// The stream of a price, if it is the price of a stream.
    pub(crate) fn stream_of(&self, price: PriceId) -> Option<StreamId> {
        price.index().checked_sub(self.first_stream).map(StreamId::new)
    }

    pub(crate) fn resource(&self, resource: ResourceId) -> PriceId {
        PriceId::new(self.first_resource + resource.index())
    }

    fn stream(&self, stream: StreamId) -> PriceId {
        PriceId::new(self.first_stream + stream.index())
    }

    /// The prices of what an alternative and its candidates claim for the device alone.
    fn alt_prices(
        &self,
        model: &Model,
        alt: AltId,
        of_alt: &IdVec<AltId, Vec<FacilityId>>,
        irregular: &IdVec<ResourceId, bool>,
        links: &mut Links,
    ) -> AltPrices {
        let mut price_all = |claims: &[Claim]| -> BTreeSet<PriceId> {
            let own = claims.iter().filter(|c| c.holder == Holder::Own && !irregular[c.resource]);
            own.map(|c| self.price_of(model, c.resource, of_alt, alt, links)).collect()
        };
        let own = price_all(&model.alt_claims[alt]);
        let cands = model.alt_cands(alt).iter();
        AltPrices { own, of_cands: cands.map(|id| price_all(&model.cand_claims[id])).collect() }
    }

    /// Gives facilities and penalties their links. Interchangeable devices share a price, but each
    /// has a link of its own.
    fn add_links(&mut self, model: &Model, links: &Links) {
        let alike = |class: DeviceId| model.class.iter().filter(|c| **c == class).count() as i64;
        for (&(tied, facility), &link) in &links.of_facility {
            let times = match tied {
                Tied::Resource(_) => 1,
                Tied::Class(Reverse(class)) => alike(class),
            };
            self.facilities[facility].links.push((link, times));
            self.ties.push(match tied {
                Tied::Resource(resource) => (link, Tie::Ticket(facility, resource)),
                Tied::Class(Reverse(class)) => (link, Tie::Link(facility, class)),
            });
        }
        let mut penalties: BTreeMap<RuleId, Vec<Link>> = BTreeMap::new();
        for (&(rule, class, place), &link) in &links.of_rule {
            let place = match place {
                Place::Role(position) => position + 1,
                Place::Alternative => 0,
            };
            self.ties.push((link, Tie::Rule(rule, class, place)));
            penalties.entry(rule).or_default().push((link, alike(class)));
        }
        let penalty = |(rule, links)| Penalty { rule, links };
        self.penalties = penalties.into_iter().map(penalty).collect();
    }

    /// The finest shift at which the sum of all prices, none above [`Self::dearest`], still fits.
    fn find_shift(&self, model: &Model) -> u32 {
        let of_facilities = self.facilities.iter().flat_map(|f| &f.links);
        let links = of_facilities.chain(self.penalties.iter().flat_map(|p| &p.links));
        let times: i64 = links.map(|l| l.1).sum();
        let terms = (self.prices.len() + model.devices.len()) as u64 + times.unsigned_abs();
        let bits = (64 - model.most.leading_zeros()) + (64 - terms.leading_zeros());
        61_u32.saturating_sub(bits + DEARER).min(16)
    }

    /// The highest price used. Higher ones are clamped to it.
    pub(crate) fn dearest(&self, model: &Model) -> u64 {
        model.most << (self.shift + DEARER)
    }

    fn price_of(
        &self,
        model: &Model,
        resource: ResourceId,
        of_alt: &IdVec<AltId, Vec<FacilityId>>,
        alt: AltId,
        links: &mut Links,
    ) -> PriceId {
        // Outputs of one channel at several frequencies: one link for each facility.
        let users = &model.resource_users[resource];
        let own = |facility: FacilityId| {
            users.iter().all(|&(part, holder)| {
                let alt = model.part_alt(part);
                holder == Holder::Own && self.excludes(model, facility, alt, of_alt)
            })
        };
        match of_alt[alt].iter().find(|facility| own(**facility)) {
            Some(facility) => links.facility(Tied::Resource(resource), *facility),
            None => self.resource(resource),
        }
    }

    /// Whether taking the alternative means either using the facility or keeping it closed.
    fn excludes(
        &self,
        model: &Model,
        facility: FacilityId,
        alt: AltId,
        of_alt: &IdVec<AltId, Vec<FacilityId>>,
    ) -> bool {
        match self.facilities[facility].resource {
            Some(price) => {
                let mut claims = model.alt_claims[alt].iter();
                claims.any(|c| self.resource(c.resource) == price)
            }
            None => of_alt[alt] == [facility],
        }
    }
}

/// Ties an alternative and its candidates to the rules that they violate. A shared wire has no
/// prices of its own; it counts only if all its candidates violate a rule.
fn add_penalties(model: &Model, alt: AltId, links: &mut Links, prices: &mut AltPrices) {
    let class = model.class[model.alt_device[alt]];
    let general = |rules: &[RuleId]| -> Vec<RuleId> {
        rules.iter().copied().filter(|&rule| !model.rule_local[rule]).collect()
    };
    for rule in general(&model.alt_rules[alt]) {
        prices.own.insert(links.rule(rule, class, Place::Alternative));
    }
    let mut of_cands = prices.of_cands.iter_mut();
    for (position, role) in model.roles.of(alt).iter().enumerate() {
        let cands = model.cands.of(role);
        let own = model.holding[role] == Holding::Own;
        for (id, of_cand) in cands.iter().zip(&mut of_cands) {
            for rule in general(&model.cand_rules[id]).into_iter().filter(|_| own) {
                of_cand.insert(links.rule(rule, class, Place::Role(position)));
            }
        }
        let first = cands.nth(0).filter(|_| !own);
        for rule in first.map_or(Vec::new(), |id| general(&model.cand_rules[id])) {
            if cands.iter().all(|id| model.cand_rules[id].contains(&rule)) {
                prices.own.insert(links.rule(rule, class, Place::Alternative));
            }
        }
    }
}

/// Resources that one device can claim in several places, or for several holders. A device never
/// conflicts with itself, so a price would charge it more than once.
fn irregular_resources(problem: &Problem, model: &Model) -> IdVec<ResourceId, bool> {
    let mut irregular = IdVec::same(false, problem.resources as usize);
    for alt in model.alt_device.ids() {
        let mut seen: BTreeMap<ResourceId, (Place, Holder)> = BTreeMap::new();
        let mut book = |place: Place, claims: &[Claim]| {
            for &Claim { resource, holder } in claims {
                let first = *seen.entry(resource).or_insert((place, holder));
                // The tie of a shared wire has a holder for each pin and carries no price.
                let groups = first.1 != Holder::Own && holder != Holder::Own;
                let tie = groups && place != Place::Alternative && first.0 == place;
                irregular[resource] |= first != (place, holder) && !tie;
            }
        };
        book(Place::Alternative, &model.alt_claims[alt]);
        for (position, role) in model.roles.of(alt).iter().enumerate() {
            let cands = model.cands.of(role).iter();
            cands.for_each(|id| book(Place::Role(position), &model.cand_claims[id]));
        }
    }
    irregular
}
