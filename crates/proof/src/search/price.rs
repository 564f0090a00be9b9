//! The least weight of everything left in a case, from multipliers.
//!
//! Every device and every facility makes the choice that is cheapest for itself, without regard for
//! the others:
//! - a device pays for pins, resources and streams that it has for itself, for the rules that it
//!   violates, and to the facilities that it uses;
//! - a facility that is used pays for what its members hold together: its resource, the pins of its
//!   wires, its streams. What its members pay to it is subtracted. It is open if a device certainly
//!   uses it, or if that saves something.
//!
//! In a wiring, at most one of them pays for a pin, a resource or a stream, so beyond its weight it
//! takes in no more than its multiplier, which is given back once. What devices pay to a facility
//! or for a rule is given back there. So no wiring weighs less than the sum, whatever the
//! multipliers are. Each opening of a facility with a cover saves something, and the saving is
//! added as often as the cover requires at least.
#![expect(clippy::indexing_slicing, reason = "places are checked where they are read")]

use super::claims::{Facilities, below, groups, violators};
use super::state::{Charge, State};
use super::statement::{Claim, Part, Statement};
use crate::format::By;
use crate::verdict::{Refuted, ensure};
use std::collections::{BTreeMap, BTreeSet};

/// Multipliers and scales stay below this, so that no sum overflows.
const MOST: u64 = 1 << 60;

/// The weights of the objective's parts, and the limit that all wirings must exceed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Weights {
    pub(crate) moved: i128,
    pub(crate) rule: i128,
    pub(crate) shared: i128,
    pub(crate) cost: i128,
    pub(crate) spare: i128,
    pub(crate) limit: i128,
}

/// How a rule is paid for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Paying {
    /// In full, by the only one that can violate it.
    Full,
    /// In parts given by the multipliers, by all that violate it.
    Parts,
}

/// The data that is the same for all multipliers.
pub(crate) struct Market<'s> {
    pub(crate) statement: &'s Statement,
    pub(crate) facilities: &'s Facilities,
    pub(crate) weights: Weights,
    paying: Vec<Paying>,
    /// The weight of a wiring without spare boards is a multiple of this.
    unit: i128,
}

impl<'s> Market<'s> {
    pub(crate) fn new(
        statement: &'s Statement,
        facilities: &'s Facilities,
        weights: Weights,
    ) -> Self {
        let Weights { moved, rule, shared, cost, .. } = weights;
        let even = cost > 0 && [moved, rule, shared].iter().all(|weight| weight % cost == 0);
        let paying = (0..statement.rules.len())
            .map(|rule| if alone(statement, rule) { Paying::Full } else { Paying::Parts });
        let unit = if even { cost } else { 1 };
        Self { statement, facilities, weights, paying: paying.collect(), unit }
    }

    fn pin(&self, pin: usize) -> i128 {
        let of = &self.statement.pins[pin];
        self.weights.cost * i128::from(of.cost) + if of.shared { self.weights.shared } else { 0 }
    }

    /// The most that a wiring can weigh.
    pub(crate) fn most(&self) -> i128 {
        let Self { statement, weights, .. } = self;
        let moved = if statement.wires.iter().any(|wire| wire.moved) { weights.moved } else { 0 };
        let all: i128 = (0..statement.pins.len()).map(|pin| self.pin(pin) + moved).sum();
        let rules = statement.rules.len() as i128 * weights.rule;
        let role = |role: usize| {
            let wires = &statement.wires[statement.roles[role].wires.clone()];
            wires
                .iter()
                .map(|wire| self.pin(wire.pin) + if wire.moved { weights.moved } else { 0 })
                .max()
                .unwrap_or(0)
        };
        let way = |way: usize| statement.ways[way].roles.clone().map(role).sum::<i128>();
        let device = |ways: &std::ops::Range<usize>| ways.clone().map(way).max().unwrap_or(0);
        let wires: i128 = statement.devices.iter().map(device).sum();
        let spares = statement.spare.iter().filter(|spare| **spare).count() as i128;
        all.min(wires) + rules + spares * weights.spare
    }
}

/// Whether in any wiring only one place of one device, or the holder of one pin, can violate the
/// rule.
fn alone(statement: &Statement, rule: usize) -> bool {
    let pin = |part: &Part| match part {
        Part::Wire(wire) => {
            let of = &statement.wires[*wire];
            statement.roles[of.role].own.then_some(of.pin)
        }
        Part::Way(_) => None,
    };
    let pins: BTreeSet<Option<usize>> = statement.rules[rule].iter().map(pin).collect();
    if pins.len() == 1 && !pins.contains(&None) {
        return true;
    }
    let mut places: BTreeMap<usize, BTreeSet<Option<usize>>> = BTreeMap::new();
    for part in &statement.rules[rule] {
        let (way, role) = match part {
            Part::Way(way) => (*way, None),
            Part::Wire(wire) => (statement.wires[*wire].way, Some(statement.wires[*wire].role)),
        };
        places.entry(way).or_default().insert(role);
    }
    let devices: BTreeSet<usize> = places.keys().map(|way| statement.ways[*way].device).collect();
    devices.len() == 1 && places.values().all(|roles| roles.len() == 1)
}

/// The multipliers of a step, ready for use.
struct Prices {
    scale: i128,
    pins: Vec<i128>,
    resources: Vec<i128>,
    /// The cost of the requests of each user of DMA.
    users: Vec<i128>,
    streams: i128,
    links: BTreeMap<(usize, usize), i128>,
    /// For each resource, the facilities that its holder pays, and how much.
    tickets: Vec<Vec<(usize, i128)>>,
    /// The most that each facility takes in by tickets.
    of_tickets: Vec<i128>,
    rules: BTreeMap<(usize, usize, usize), i128>,
    /// The sum of what is paid for each rule.
    of_rules: BTreeMap<usize, i128>,
    /// The amount that each facility saves.
    savings: Vec<i128>,
    covers: i128,
}

impl Prices {
    fn new(market: &Market<'_>, by: &By) -> Result<Self, Refuted> {
        let Market { statement, facilities, .. } = market;
        let rows = [&by.pins, &by.resources, &by.streams, &by.links, &by.tickets, &by.rules];
        let mut all = rows.into_iter().chain([&by.covers]).flatten().chain([&by.scale]);
        ensure(all.all(|number| *number < MOST), || "a multiplier is too large".into())?;
        ensure(by.scale > 0, || "a scale is 0".into())?;
        let one = |row, most: usize, kind| -> Result<Vec<i128>, Refuted> {
            let mut all = vec![0; most];
            for [place, price] in groups::<2>(row)? {
                all[below(place, most, kind)?] = i128::from(price);
            }
            Ok(all)
        };
        let streams = one(&by.streams, statement.streams, "stream")?;
        let least = |request: &BTreeSet<usize>| request.iter().map(|s| streams[*s]).min();
        let user = |all: &Vec<BTreeSet<usize>>| all.iter().filter_map(least).sum();
        let mut prices = Self {
            scale: i128::from(by.scale),
            pins: one(&by.pins, statement.pins.len(), "pin")?,
            resources: one(&by.resources, statement.resources.len(), "resource")?,
            users: statement.users.iter().map(user).collect(),
            streams: streams.iter().sum(),
            links: BTreeMap::new(),
            tickets: vec![Vec::new(); statement.resources.len()],
            of_tickets: vec![0; facilities.all.len()],
            rules: BTreeMap::new(),
            of_rules: BTreeMap::new(),
            savings: vec![0; facilities.all.len()],
            covers: 0,
        };
        for [facility, device, price] in groups::<3>(&by.links)? {
            let facility = below(facility, facilities.all.len(), "facility")?;
            let device = below(device, statement.devices.len(), "device")?;
            prices.links.insert((facility, device), i128::from(price));
        }
        let mut seen = BTreeSet::new();
        for [facility, resource, price] in groups::<3>(&by.tickets)? {
            let facility = below(facility, facilities.all.len(), "facility")?;
            let resource = below(resource, statement.resources.len(), "resource")?;
            ensure(seen.insert((facility, resource)), || "a ticket is there twice".into())?;
            prices.tickets[resource].push((facility, i128::from(price)));
            prices.of_tickets[facility] += i128::from(price);
        }
        prices.read_rules(market, by)?;
        for [cover, price] in groups::<2>(&by.covers)? {
            let cover = &facilities.covers[below(cover, facilities.covers.len(), "cover")?];
            prices.covers += i128::from(price) * cover.need as i128;
            for facility in &cover.great {
                prices.savings[*facility] += i128::from(price);
            }
        }
        Ok(prices)
    }

    fn read_rules(&mut self, market: &Market<'_>, by: &By) -> Result<(), Refuted> {
        let statement = market.statement;
        for [rule, device, place, price] in groups::<4>(&by.rules)? {
            let rule = below(rule, statement.rules.len(), "rule")?;
            let device = below(device, statement.devices.len(), "device")?;
            let place = usize::try_from(place).unwrap_or(usize::MAX);
            let price = i128::from(price);
            let old = self.rules.insert((rule, device, place), price);
            ensure(old.is_none(), || "a rule is paid twice".into())?;
            *self.of_rules.entry(rule).or_default() += price;
        }
        for (rule, sum) in &mut self.of_rules {
            // A payment that nobody can make is not given back.
            let paid = violators(statement, *rule).into_iter();
            let paid = paid.filter_map(|(device, at)| self.rules.get(&(*rule, device, at)));
            *sum = paid.sum();
        }
        Ok(())
    }
}

/// All payments in a case.
struct Bill {
    /// The cost of each candidate.
    wires: Vec<i128>,
    /// The cheapest candidate of each role.
    roles: Vec<i128>,
    ways: Vec<i128>,
    devices: Vec<i128>,
    /// The cost of opening each facility; `None` if no device can use it.
    openings: Vec<Option<Opening>>,
    /// The cost of violating each rule that is paid in parts and not decided.
    rules: Vec<(usize, i128)>,
    /// The weight that is proved, without spare boards.
    sum: i128,
    /// The weight of the spare boards in use.
    spares: i128,
    work: usize,
}

/// The cost of a facility.
struct Opening {
    cost: i128,
    forced: bool,
    /// The cheapest place of each wire.
    wires: Vec<i128>,
}

impl Market<'_> {
    /// Whether the multipliers show that everything that is left weighs more than the limit.
    pub(crate) fn closes(&self, state: &State, by: &By) -> Result<(bool, usize), Refuted> {
        let prices = Prices::new(self, by)?;
        let bill = self.bill(state, &prices);
        Ok((self.beyond(&bill, bill.sum, prices.scale), bill.work))
    }

    /// Whether such a sum is above the limit.
    fn beyond(&self, bill: &Bill, sum: i128, scale: i128) -> bool {
        let whole = self.unit * scale;
        let units = sum.div_euclid(whole) + i128::from(sum.rem_euclid(whole) > 0);
        units.max(0) * self.unit + bill.spares > self.weights.limit
    }

    fn bill(&self, state: &State, prices: &Prices) -> Bill {
        let statement = self.statement;
        let mut bill = Bill {
            wires: vec![0; statement.wires.len()],
            roles: vec![0; statement.roles.len()],
            ways: vec![0; statement.ways.len()],
            devices: Vec::new(),
            openings: Vec::new(),
            rules: Vec::new(),
            sum: prices.covers - prices.streams,
            spares: 0,
            work: statement.ways.len() + statement.pins.len() + statement.resources.len(),
        };
        bill.sum -= prices.pins.iter().chain(&prices.resources).sum::<i128>();
        for device in 0..statement.devices.len() {
            let mut least: Option<i128> = None;
            for way in state.ways(statement, device) {
                let cost = self.way(state, prices, way, &mut bill);
                bill.ways[way] = cost;
                least = Some(least.map_or(cost, |least| least.min(cost)));
            }
            // A device that has nothing left ends the case elsewhere.
            bill.devices.push(least.unwrap_or(0));
            bill.sum += least.unwrap_or(0);
        }
        for facility in 0..self.facilities.all.len() {
            let opening = self.opening(state, prices, facility, &mut bill.work);
            if let Some(Opening { cost, forced, .. }) = &opening {
                bill.sum += if *forced { *cost } else { (*cost).min(0) };
            }
            bill.openings.push(opening);
        }
        let weight = self.weights.rule * prices.scale;
        for (rule, charge) in state.rule.iter().enumerate() {
            let parts = prices.of_rules.get(&rule).copied().unwrap_or(0);
            if *charge == Charge::Paid {
                bill.sum += weight;
            } else if *charge == Charge::Open && self.paying[rule] == Paying::Parts {
                bill.rules.push((rule, weight - parts));
                bill.sum += (weight - parts).min(0);
            }
        }
        let boards = state.board.iter().zip(&statement.spare);
        let used = boards.filter(|(charge, spare)| **charge == Charge::Paid && **spare);
        bill.spares = used.count() as i128 * self.weights.spare;
        bill
    }

    /// The least that a device pays for an alternative.
    fn way(&self, state: &State, prices: &Prices, way: usize, bill: &mut Bill) -> i128 {
        let of = &self.statement.ways[way];
        let facilities = &self.facilities.of_way[way];
        let mut sum = self.claims(prices, way, &of.claims);
        for facility in facilities {
            sum += prices.links.get(&(*facility, of.device)).copied().unwrap_or(0);
        }
        sum += self.rules(state, prices, (of.device, 0), &of.rules);
        let implied = of.implied.iter().filter(|rule| self.paying[**rule] == Paying::Parts);
        sum += self.rules(state, prices, (of.device, 0), implied);
        for user in &of.users {
            let direct = self.facilities.direct[*user].is_some_and(|resource| {
                of.claims.iter().any(|claim| claim.resource == resource && claim.holder == 0)
            });
            if self.facilities.private[*user] || direct {
                sum += prices.users[*user];
            }
        }
        for (place, role) in of.roles.clone().enumerate() {
            let own = self.statement.roles[role].own;
            let mut least: Option<i128> = None;
            for wire in state.wires(self.statement, role) {
                let one = &self.statement.wires[wire];
                let mut cost = self.claims(prices, way, &one.claims);
                cost += self.rules(state, prices, (of.device, place + 1), &one.rules);
                if own {
                    let moved = if one.moved { self.weights.moved } else { 0 };
                    cost += (self.pin(one.pin) + moved) * prices.scale + prices.pins[one.pin];
                }
                bill.work += 1 + one.claims.len();
                bill.wires[wire] = cost;
                least = Some(least.map_or(cost, |least| least.min(cost)));
            }
            bill.roles[role] = least.unwrap_or(0);
            sum += bill.roles[role];
        }
        sum
    }

    fn claims(&self, prices: &Prices, way: usize, claims: &[Claim]) -> i128 {
        let mut sum = 0;
        for claim in claims.iter().filter(|claim| claim.holder == 0 && claim.first) {
            sum += prices.resources[claim.resource];
            for (facility, price) in &prices.tickets[claim.resource] {
                if self.facilities.of_way[way].contains(facility) {
                    sum += price;
                }
            }
        }
        sum
    }

    fn rules<'r>(
        &self,
        state: &State,
        prices: &Prices,
        (device, place): (usize, usize),
        rules: impl IntoIterator<Item = &'r usize>,
    ) -> i128 {
        let open = rules.into_iter().filter(|rule| state.rule[**rule] != Charge::Paid);
        let paid = open.map(|rule| match self.paying[*rule] {
            Paying::Full => self.weights.rule * prices.scale,
            Paying::Parts => prices.rules.get(&(*rule, device, place)).copied().unwrap_or(0),
        });
        paid.sum()
    }

    fn opening(
        &self,
        state: &State,
        prices: &Prices,
        number: usize,
        work: &mut usize,
    ) -> Option<Opening> {
        let statement = self.statement;
        let facility = &self.facilities.all[number];
        let alive = |way: &usize| state.way[*way];
        if !facility.members.iter().any(alive) {
            return None;
        }
        *work += facility.members.len();
        let sure = |way: usize| state.way[way] && state.has_one(statement.ways[way].device);
        let decided: Vec<bool> = facility.members.iter().map(|way| sure(*way)).collect();
        let forced = state.open[number] || decided.contains(&true);
        let mut cost = facility.resource.map_or(0, |resource| prices.resources[resource]);
        let mut wires = Vec::new();
        for roles in &facility.wires {
            let at = |role: usize| {
                state.wires(statement, role).map(|wire| self.place(prices, wire)).min()
            };
            let members = || facility.members.iter().zip(roles).zip(&decided);
            // A member that is certain holds one of its own places.
            let sure = members().filter(|(_, sure)| **sure).filter_map(|((_, role), _)| at(*role));
            let all = members().filter(|((way, _), _)| alive(way));
            let least = sure.max().or_else(|| all.filter_map(|((_, role), _)| at(*role)).min());
            *work += roles.len();
            wires.push(least.unwrap_or(0));
        }
        cost += wires.iter().sum::<i128>();
        cost += facility.users.iter().map(|user| prices.users[*user]).sum::<i128>();
        let devices: BTreeSet<usize> = facility
            .members
            .iter()
            .filter(|way| alive(way))
            .map(|way| statement.ways[*way].device)
            .collect();
        let links = devices.into_iter().filter_map(|device| prices.links.get(&(number, device)));
        cost -= links.sum::<i128>() + prices.of_tickets[number];
        Some(Opening { cost: cost - prices.savings[number], forced, wires })
    }

    /// The price that a facility pays for a place.
    fn place(&self, prices: &Prices, wire: usize) -> i128 {
        let of = &self.statement.wires[wire];
        let moved = self.facilities.moved.get(&of.place()) == Some(&true);
        let moved = if moved { self.weights.moved } else { 0 };
        (self.pin(of.pin) + moved) * prices.scale + prices.pins[of.pin]
    }

    /// Removes everything that weighs too much.
    pub(crate) fn narrow(&self, state: &mut State, by: &By) -> Result<usize, Refuted> {
        let statement = self.statement;
        let prices = Prices::new(self, by)?;
        let bill = self.bill(state, &prices);
        let beyond = |more: i128| self.beyond(&bill, bill.sum + more, prices.scale);
        let (mut ways, mut wires) = (Vec::new(), Vec::new());
        for device in 0..statement.devices.len() {
            for way in state.ways(statement, device) {
                let over = bill.ways[way] - bill.devices[device];
                if beyond(over) {
                    ways.push(way);
                    continue;
                }
                for role in statement.ways[way].roles.clone() {
                    let left = state.wires(statement, role);
                    wires.extend(
                        left.filter(|wire| beyond(over + bill.wires[*wire] - bill.roles[role])),
                    );
                }
            }
        }
        for (facility, opening) in self.facilities.all.iter().zip(&bill.openings) {
            let Some(Opening { cost, forced, wires: least }) = opening else { continue };
            let over = if *forced { 0 } else { (*cost).max(0) };
            if beyond(over) {
                ways.extend(&facility.members);
                continue;
            }
            for (roles, least) in facility.wires.iter().zip(least) {
                for (_, role) in
                    facility.members.iter().zip(roles).filter(|(way, _)| state.way[**way])
                {
                    let left = state.wires(statement, *role);
                    let dear = |wire: &usize| beyond(over + self.place(&prices, *wire) - least);
                    wires.extend(left.filter(dear));
                }
            }
        }
        for (rule, cost) in &bill.rules {
            if beyond((*cost).max(0)) {
                state.close_rule(statement, *rule);
            } else if beyond((-*cost).max(0)) {
                state.pay_rule(*rule);
            }
        }
        ways.into_iter().for_each(|way| state.remove_way(statement, way));
        wires.into_iter().for_each(|wire| state.remove_wire(statement, wire));
        Ok(bill.work)
    }
}
