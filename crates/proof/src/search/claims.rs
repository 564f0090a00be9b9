//! Checks what a record says besides its steps: facilities, covers and swaps.
#![expect(clippy::indexing_slicing, reason = "places are checked where they are read")]

use super::state::State;
use super::statement::{Asked, Claim, Part, Statement};
use crate::format::{self, Row};
use crate::verdict::{Refuted, ensure};
use std::collections::{BTreeMap, BTreeSet};

/// Checks that a number is below another one.
pub(crate) fn below(number: u64, most: usize, kind: &str) -> Result<usize, Refuted> {
    let place = usize::try_from(number).ok().filter(|place| *place < most);
    place.ok_or_else(|| Refuted(format!("the search has no {kind} {number}")))
}

/// The groups of `N` numbers in a row.
pub(crate) fn groups<const N: usize>(row: &Row) -> Result<Vec<[u64; N]>, Refuted> {
    let chunks = row.chunks_exact(N);
    ensure(chunks.remainder().is_empty(), || "a row of the search has an odd end".into())?;
    Ok(chunks.filter_map(|chunk| <[u64; N]>::try_from(chunk).ok()).collect())
}

fn all_below(row: &Row, most: usize, kind: &str) -> Result<Vec<usize>, Refuted> {
    row.iter().map(|number| below(*number, most, kind)).collect()
}

/// The alternative of a device.
pub(crate) fn way_of(statement: &Statement, device: u64, place: u64) -> Result<usize, Refuted> {
    let ways = &statement.devices[below(device, statement.devices.len(), "device")?];
    Ok(ways.start + below(place, ways.len(), "alternative")?)
}

/// A checked facility.
#[derive(Debug, Default)]
pub(crate) struct Facility {
    pub(crate) members: Vec<usize>,
    pub(crate) resource: Option<usize>,
    /// For each wire, the role of every member.
    pub(crate) wires: Vec<Vec<usize>>,
    pub(crate) users: Vec<usize>,
    slots: BTreeSet<usize>,
}

/// Facilities of which at least `need` are open in every wiring.
#[derive(Debug)]
pub(crate) struct Cover {
    pub(crate) great: Vec<usize>,
    pub(crate) need: usize,
}

/// All facilities.
#[derive(Debug, Default)]
pub(crate) struct Facilities {
    pub(crate) all: Vec<Facility>,
    /// The facilities of each alternative.
    pub(crate) of_way: Vec<Vec<usize>>,
    /// For each place on a wire of a facility, whether every wire there counts as moved.
    pub(crate) moved: BTreeMap<(usize, usize, usize), bool>,
    /// For each user of DMA, whether every use excludes all others.
    pub(crate) private: Vec<bool>,
    /// For each user of DMA, the resource by which its facilities exclude each other: a device that
    /// has it for itself pays for the streams itself.
    pub(crate) direct: Vec<Option<usize>>,
    pub(crate) covers: Vec<Cover>,
}

impl Facilities {
    pub(crate) fn new(statement: &Statement, search: &format::Search) -> Result<Self, Refuted> {
        let mut facilities = Self {
            of_way: vec![Vec::new(); statement.ways.len()],
            private: private(statement),
            direct: vec![None; statement.users.len()],
            ..Self::default()
        };
        let mut occupied = BTreeSet::new();
        for (number, stated) in search.facilities.iter().enumerate() {
            let facility = Facility::new(statement, stated)?;
            if let Some(resource) = facility.resource {
                let holder = facility.holder(statement, resource)?;
                let new = occupied.insert((resource, holder));
                ensure(new, || format!("facility {number} is there twice"))?;
            }
            facility.members.iter().for_each(|way| facilities.of_way[*way].push(number));
            facilities.all.push(facility);
        }
        facilities.check_places(statement)?;
        facilities.check_users(statement)?;
        for cover in &search.covers {
            let cover = facilities.cover(statement, cover)?;
            facilities.covers.push(cover);
        }
        Ok(facilities)
    }

    /// Checks that a place is on one wire of one facility, and not on a wire that a device has for
    /// itself.
    fn check_places(&mut self, statement: &Statement) -> Result<(), Refuted> {
        let mut owners = BTreeMap::new();
        for (number, facility) in self.all.iter().enumerate() {
            for (wire, roles) in facility.wires.iter().enumerate() {
                for role in roles.iter().map(|role| &statement.roles[*role]) {
                    ensure(!role.own, || format!("facility {number} shares what is not shared"))?;
                    for one in &statement.wires[role.wires.clone()] {
                        let owner = owners.entry(one.place()).or_insert((number, wire));
                        ensure(*owner == (number, wire), || {
                            format!("facility {number} has a wire of another one")
                        })?;
                        *self.moved.entry(one.place()).or_insert(true) &= one.moved;
                    }
                }
            }
        }
        Ok(())
    }

    /// Checks that only one facility at a time pays for the streams of a user.
    fn check_users(&mut self, statement: &Statement) -> Result<(), Refuted> {
        for user in 0..statement.users.len() {
            let payers: Vec<&Facility> =
                self.all.iter().filter(|facility| facility.users.contains(&user)).collect();
            let Some(first) = payers.first() else { continue };
            let same = payers.iter().all(|one| one.resource == first.resource);
            let alone = payers.len() == 1 || (same && first.resource.is_some());
            ensure(alone && !self.private[user], || {
                format!("the streams of user {user} are paid twice")
            })?;
            self.direct[user] = first.resource;
        }
        Ok(())
    }

    fn cover(&self, statement: &Statement, stated: &format::Cover) -> Result<Cover, Refuted> {
        let devices = all_below(&stated.devices, statement.devices.len(), "device")?;
        let devices: BTreeSet<usize> = devices.into_iter().collect();
        let great: BTreeSet<usize> =
            all_below(&stated.great, self.all.len(), "facility")?.into_iter().collect();
        let small: BTreeSet<usize> =
            all_below(&stated.small, self.all.len(), "facility")?.into_iter().collect();
        let need = below(stated.need, great.len() + 1, "facility")?;
        for device in &devices {
            let mut ways = statement.devices[*device].clone();
            let known = |facility: &usize| great.contains(facility) || small.contains(facility);
            let inside = ways.all(|way| self.of_way[way].iter().any(known));
            ensure(inside, || format!("device {device} needs none of a cover"))?;
        }
        let room = |facility: &usize| self.all[*facility].room(statement, &devices);
        let mut rooms: Vec<usize> = great.iter().map(room).collect();
        rooms.sort_unstable_by(|one, other| other.cmp(one));
        let rest: usize = small.iter().map(room).sum();
        let most: usize = rooms.iter().take(need.saturating_sub(1)).sum();
        ensure(need == 0 || rest + most < devices.len(), || {
            "a cover needs fewer facilities than it says".into()
        })?;
        Ok(Cover { great: great.into_iter().collect(), need })
    }
}

impl Facility {
    fn new(statement: &Statement, stated: &format::Facility) -> Result<Self, Refuted> {
        let mut members = Vec::new();
        let mut seen = BTreeSet::new();
        for [device, place] in groups::<2>(&stated.members)? {
            let way = way_of(statement, device, place)?;
            ensure(seen.insert(way), || "a member of a facility is there twice".into())?;
            members.push(way);
        }
        let resource = stated.resource.map(|r| below(r, statement.resources.len(), "resource"));
        let users = all_below(&stated.users, statement.users.len(), "user of DMA")?;
        let users: BTreeSet<usize> = users.into_iter().collect();
        let all =
            |user: &usize| members.iter().all(|way| statement.ways[*way].users.contains(user));
        ensure(users.iter().all(all), || {
            "a facility pays for streams that it may not need".into()
        })?;
        let slots = all_below(&stated.slots, statement.resources.len(), "resource")?;
        let mut wires = Vec::new();
        for wire in &stated.wires {
            ensure(wire.len() == members.len(), || "a wire misses a member".into())?;
            let roles = wire.iter().zip(&members).map(|(role, way)| {
                let roles = &statement.ways[*way].roles;
                Ok(roles.start + below(*role, roles.len(), "role")?)
            });
            wires.push(roles.collect::<Result<Vec<usize>, Refuted>>()?);
        }
        Ok(Self {
            members,
            resource: resource.transpose()?,
            wires,
            users: users.into_iter().collect(),
            slots: slots.into_iter().collect(),
        })
    }

    /// The group as which all members hold the facility's resource.
    fn holder(&self, statement: &Statement, resource: usize) -> Result<usize, Refuted> {
        let held = |way: &usize| {
            let mut claims = statement.ways[*way].claims.iter();
            claims.find(|claim| claim.resource == resource).map_or(0, |claim| claim.holder)
        };
        let holders: BTreeSet<usize> = self.members.iter().map(held).collect();
        let one = holders.first().copied().filter(|holder| *holder != 0 && holders.len() == 1);
        one.ok_or_else(|| Refuted("a facility is not held as one group".into()))
    }

    /// The most of these devices that it can serve.
    fn room(&self, statement: &Statement, devices: &BTreeSet<usize>) -> usize {
        let members =
            self.members.iter().filter(|way| devices.contains(&statement.ways[**way].device));
        let members: Vec<usize> = members.copied().collect();
        let own = |claims: &[Claim]| {
            claims.iter().any(|claim| claim.holder == 0 && self.slots.contains(&claim.resource))
        };
        let slotted = |way: &&usize| {
            let of = &statement.ways[**way];
            own(&of.claims)
                || of.roles.clone().any(|role| {
                    let mut wires = statement.roles[role].wires.clone();
                    wires.all(|wire| own(&statement.wires[wire].claims))
                })
        };
        let different: BTreeSet<usize> =
            members.iter().map(|way| statement.ways[*way].device).collect();
        // A device that may be here without a slot counts by itself.
        let loose = members.iter().filter(|way| !slotted(way));
        let loose: BTreeSet<usize> = loose.map(|way| statement.ways[*way].device).collect();
        let slots = self.slots.len() + loose.len();
        let places = members.iter().map(|way| statement.ways[*way].roles.len()).min().unwrap_or(0);
        let pins = (0..places).filter_map(|place| pins_at(statement, &members, place)).min();
        slots.min(different.len()).min(pins.unwrap_or(usize::MAX))
    }
}

/// The number of pins for a role, if each of these alternatives has the role for itself.
fn pins_at(statement: &Statement, members: &[usize], place: usize) -> Option<usize> {
    let mut pins = BTreeSet::new();
    for way in members {
        let role = &statement.roles[statement.ways[*way].roles.start + place];
        if !role.own {
            return None;
        }
        pins.extend(statement.wires[role.wires.clone()].iter().map(|wire| wire.pin));
    }
    Some(pins.len())
}

/// For each user of DMA, whether only one device can use it, or all devices that do take one
/// resource for themselves.
fn private(statement: &Statement) -> Vec<bool> {
    let mut users: Vec<Option<(usize, bool, BTreeSet<usize>)>> = vec![None; statement.users.len()];
    for way in &statement.ways {
        let own = way.claims.iter().filter(|claim| claim.holder == 0).map(|claim| claim.resource);
        let own: BTreeSet<usize> = own.collect();
        for user in &way.users {
            let entry = users[*user].get_or_insert_with(|| (way.device, true, own.clone()));
            entry.1 &= entry.0 == way.device;
            entry.2 = &entry.2 & &own;
        }
    }
    users.into_iter().map(|user| user.is_some_and(|(_, one, own)| one || !own.is_empty())).collect()
}

/// An exchange of places that maps the statement to itself. It is its own inverse.
#[derive(Debug)]
pub(crate) struct Swap {
    maps: Maps,
    /// The alternatives and candidates that become others.
    ways: BTreeMap<usize, usize>,
    wires: BTreeMap<usize, usize>,
}

/// The numbers from 0, some of which change places in pairs.
fn paired(row: &Row, most: usize, kind: &str) -> Result<Vec<usize>, Refuted> {
    let mut map: Vec<usize> = (0..most).collect();
    for [one, other] in groups::<2>(row)? {
        let (one, other) = (below(one, most, kind)?, below(other, most, kind)?);
        ensure(map[one] == one && map[other] == other, || format!("a {kind} is swapped twice"))?;
        map[one] = other;
        map[other] = one;
    }
    Ok(map)
}

/// The effect of a swap on numbers.
#[derive(Debug)]
struct Maps {
    boards: Vec<usize>,
    pins: Vec<usize>,
    resources: Vec<usize>,
    holders: Vec<usize>,
    users: Vec<usize>,
    rules: Vec<usize>,
    devices: Vec<usize>,
    ways: Vec<usize>,
}

impl Swap {
    pub(crate) fn new(statement: &Statement, stated: &format::Swap) -> Result<Self, Refuted> {
        let streams = paired(&stated.streams, statement.streams, "stream")?;
        let maps = Maps::new(statement, stated)?;
        let board = |(one, other): (usize, &usize)| statement.spare[one] == statement.spare[*other];
        let pin = |(one, other): (usize, &usize)| {
            let (one, other) = (&statement.pins[one], &statement.pins[*other]);
            (one.cost, one.shared) == (other.cost, other.shared)
        };
        let user = |(one, other): (usize, &usize)| {
            let image = |request: &BTreeSet<usize>| -> BTreeSet<usize> {
                request.iter().map(|stream| streams[*stream]).collect()
            };
            statement.users[one].iter().map(image).eq(statement.users[*other].iter().cloned())
        };
        let things = maps.boards.iter().enumerate().all(board)
            && maps.pins.iter().enumerate().all(pin)
            && maps.users.iter().enumerate().all(user)
            && maps.holders.first() == Some(&0);
        ensure(things, || "a swap changes boards, pins or streams".into())?;
        let (mut ways, mut wires) = (BTreeMap::new(), BTreeMap::new());
        for (way, image) in maps.ways.iter().enumerate() {
            if way != *image {
                ways.insert(way, *image);
            } else if maps.leaves(statement, way) {
                continue;
            }
            let same = maps.way(statement, way, *image, &mut wires);
            ensure(same, || format!("a swap changes alternative {way}"))?;
        }
        Ok(Self { maps, ways, wires })
    }

    /// How much it moves, a measure of the time it takes.
    pub(crate) fn size(&self) -> usize {
        1 + self.ways.len() + self.wires.len() + self.maps.boards.len() + self.maps.rules.len()
    }

    fn way(&self, way: usize) -> usize {
        self.ways.get(&way).copied().unwrap_or(way)
    }

    /// The questions into which a swap turns a question.
    pub(crate) fn images(&self, asked: Asked, facilities: &Facilities) -> Vec<Asked> {
        vec![match asked {
            Asked::Way(way) => Asked::Way(self.way(way)),
            Asked::Wire(wire) => Asked::Wire(self.wires.get(&wire).copied().unwrap_or(wire)),
            Asked::Kept(rule) => Asked::Kept(self.maps.rules[rule]),
            Asked::Unused(board) => Asked::Unused(self.maps.boards[board]),
            Asked::Member(way) => Asked::Member(self.way(way)),
            Asked::Open(facility) => {
                let members = facilities.all[facility].members.iter();
                return members.map(|way| Asked::Member(self.way(*way))).collect();
            }
        }]
    }

    /// Whether the swap leaves a case as it is.
    pub(crate) fn keeps(&self, state: &State, facilities: &Facilities) -> bool {
        let boards = self.maps.boards.iter().enumerate();
        let rules = self.maps.rules.iter().enumerate();
        let is_open = |number: &usize| state.open[*number];
        // A device that uses this facility becomes one that uses an open facility.
        let stays =
            |number: usize| {
                let members = &facilities.all[number].members;
                let of_first = members.first().map(|way| &facilities.of_way[self.way(*way)]);
                of_first.into_iter().flatten().filter(|to| is_open(to)).any(|to| {
                    members.iter().all(|way| facilities.of_way[self.way(*way)].contains(to))
                })
            };
        self.ways.iter().all(|(way, image)| state.way[*way] == state.way[*image])
            && self.wires.iter().all(|(wire, image)| state.wire[*wire] == state.wire[*image])
            && boards.into_iter().all(|(one, other)| state.board[one] == state.board[*other])
            && rules.into_iter().all(|(one, other)| state.rule[one] == state.rule[*other])
            && (0..facilities.all.len()).filter(is_open).all(stays)
    }
}

impl Maps {
    fn new(statement: &Statement, stated: &format::Swap) -> Result<Self, Refuted> {
        let devices = paired(&stated.devices, statement.devices.len(), "device")?;
        let mut pairs = Vec::new();
        for [device, one, other] in groups::<3>(&stated.ways)? {
            let ways = [way_of(statement, device, one)?, way_of(statement, device, other)?];
            pairs.extend(ways.map(|way| way as u64));
        }
        for (one, other) in devices.iter().enumerate().filter(|(one, other)| one < *other) {
            let (one, other) = (&statement.devices[one], &statement.devices[*other]);
            ensure(one.len() == other.len(), || "a swap changes a device".into())?;
            pairs.extend(one.clone().zip(other.clone()).flat_map(|(a, b)| [a as u64, b as u64]));
        }
        Ok(Self {
            boards: paired(&stated.boards, statement.spare.len(), "board")?,
            pins: paired(&stated.pins, statement.pins.len(), "pin")?,
            resources: paired(&stated.resources, statement.resources.len(), "resource")?,
            holders: paired(&stated.holders, statement.holders, "holder")?,
            users: paired(&stated.users, statement.users.len(), "user of DMA")?,
            rules: paired(&stated.rules, statement.rules.len(), "rule")?,
            devices,
            ways: paired(&pairs, statement.ways.len(), "alternative")?,
        })
    }

    fn claims(&self, claims: &[Claim]) -> BTreeSet<(usize, usize, bool)> {
        let image = |claim: &Claim| {
            (self.resources[claim.resource], self.holders[claim.holder], claim.first)
        };
        claims.iter().map(image).collect()
    }

    fn rules(&self, rules: &[usize]) -> BTreeSet<usize> {
        rules.iter().map(|rule| self.rules[*rule]).collect()
    }

    /// Whether everything that an alternative names stays the same.
    fn leaves(&self, statement: &Statement, way: usize) -> bool {
        let of = &statement.ways[way];
        let claims = |claims: &[Claim]| {
            let mut all = claims.iter();
            all.all(|c| {
                self.resources[c.resource] == c.resource && self.holders[c.holder] == c.holder
            })
        };
        let rules = |rules: &[usize]| rules.iter().all(|rule| self.rules[*rule] == *rule);
        let mut wires = of.roles.clone().flat_map(|role| statement.roles[role].wires.clone());
        self.boards[of.board] == of.board
            && claims(&of.claims)
            && rules(&of.rules)
            && of.users.iter().all(|user| self.users[*user] == *user)
            && wires.all(|wire| {
                let one = &statement.wires[wire];
                self.pins[one.pin] == one.pin
                    && self.holders[one.holder] == one.holder
                    && claims(&one.claims)
                    && rules(&one.rules)
            })
    }

    /// Whether one alternative becomes the other; records what its candidates become.
    fn way(
        &self,
        statement: &Statement,
        way: usize,
        image: usize,
        wires: &mut BTreeMap<usize, usize>,
    ) -> bool {
        let (one, other) = (&statement.ways[way], &statement.ways[image]);
        let plain = |claims: &[Claim]| -> BTreeSet<(usize, usize, bool)> {
            claims.iter().map(|claim| (claim.resource, claim.holder, claim.first)).collect()
        };
        let set = |numbers: &[usize]| -> BTreeSet<usize> { numbers.iter().copied().collect() };
        let users: BTreeSet<usize> = one.users.iter().map(|user| self.users[*user]).collect();
        let mut roles = one.roles.clone().zip(other.roles.clone());
        self.devices[one.device] == other.device
            && self.boards[one.board] == other.board
            && self.claims(&one.claims) == plain(&other.claims)
            && self.rules(&one.rules) == set(&other.rules)
            && users == set(&other.users)
            && one.roles.len() == other.roles.len()
            && roles.all(|(role, image)| {
                let (from, to) = (&statement.roles[role].wires, &statement.roles[image].wires);
                let places: BTreeMap<_, usize> =
                    to.clone().map(|wire| (statement.wires[wire].place(), wire)).collect();
                from.len() == to.len()
                    && places.len() == to.len()
                    && from.clone().all(|wire| {
                        let of = &statement.wires[wire];
                        let place = (self.pins[of.pin], self.holders[of.holder], of.signal);
                        let Some(found) = places.get(&place) else { return false };
                        let to = &statement.wires[*found];
                        wires.insert(wire, *found);
                        of.moved == to.moved
                            && self.rules(&of.rules) == set(&to.rules)
                            && self.claims(&of.claims) == plain(&to.claims)
                    })
            })
    }
}

/// The devices that violate a rule, each with the places where it does: 0, or the role plus 1. A
/// rule that all candidates of a role violate is also violated at 0.
pub(crate) fn violators(statement: &Statement, rule: usize) -> BTreeSet<(usize, usize)> {
    let places = |part: &Part| match part {
        Part::Way(way) => vec![(statement.ways[*way].device, 0)],
        Part::Wire(wire) => {
            let of = &statement.wires[*wire];
            let way = &statement.ways[of.way];
            let own = (of.device, of.role - way.roles.start + 1);
            let whole = way.implied.contains(&rule).then_some((of.device, 0));
            std::iter::once(own).chain(whole).collect()
        }
    };
    statement.rules[rule].iter().flat_map(places).collect()
}
