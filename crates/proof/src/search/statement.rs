//! The problem in numbers: everything is numbered in the order of names, and indexed by its users.
#![expect(clippy::indexing_slicing, reason = "places are checked where they are read")]

use crate::format::{Alternative, Candidate, Map, OWN, Problem};
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

/// A question in numbers of the statement.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Asked {
    Way(usize),
    Wire(usize),
    Kept(usize),
    Unused(usize),
    Open(usize),
    /// An alternative that is refused alone: the image of a member of a facility.
    Member(usize),
}

/// On whose behalf something is held: 0 for the device alone, else the number of a group.
pub(crate) type Holder = usize;

/// A resource that is taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Claim {
    pub(crate) resource: usize,
    pub(crate) holder: Holder,
    /// Whether the device could not have taken it at an earlier place of this alternative.
    pub(crate) first: bool,
}

/// A part of the problem that claims a resource or violates a rule.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Part {
    Way(usize),
    Wire(usize),
}

/// An alternative.
#[derive(Debug)]
pub(crate) struct Way {
    pub(crate) device: usize,
    pub(crate) board: usize,
    pub(crate) claims: Vec<Claim>,
    pub(crate) rules: Vec<usize>,
    /// Further rules, which all candidates of a role violate.
    pub(crate) implied: BTreeSet<usize>,
    pub(crate) users: Vec<usize>,
    /// Its roles.
    pub(crate) roles: Range<usize>,
}

/// A role of an alternative.
#[derive(Debug)]
pub(crate) struct Role {
    pub(crate) way: usize,
    /// Its candidates.
    pub(crate) wires: Range<usize>,
    /// Whether no other device can hold any of its pins on the same behalf.
    pub(crate) own: bool,
    /// Resources that all of its candidates take as a group.
    pub(crate) ties: Vec<usize>,
}

/// A candidate.
#[derive(Debug)]
pub(crate) struct Wire {
    pub(crate) role: usize,
    pub(crate) way: usize,
    pub(crate) device: usize,
    pub(crate) pin: usize,
    pub(crate) holder: Holder,
    pub(crate) signal: usize,
    pub(crate) moved: bool,
    pub(crate) claims: Vec<Claim>,
    pub(crate) rules: Vec<usize>,
}

/// A pin: its cost, whether it is shared, and the candidates that can hold it.
#[derive(Debug)]
pub(crate) struct Pin {
    pub(crate) cost: u32,
    pub(crate) shared: bool,
    pub(crate) wires: Vec<usize>,
}

/// The numbered problem.
#[derive(Debug, Default)]
pub(crate) struct Statement {
    /// The alternatives of each device.
    pub(crate) devices: Vec<Range<usize>>,
    pub(crate) ways: Vec<Way>,
    pub(crate) roles: Vec<Role>,
    pub(crate) wires: Vec<Wire>,
    pub(crate) pins: Vec<Pin>,
    /// For each board, whether it is a spare one.
    pub(crate) spare: Vec<bool>,
    /// For each user of DMA, its requests, as streams.
    pub(crate) users: Vec<Vec<BTreeSet<usize>>>,
    pub(crate) streams: usize,
    pub(crate) holders: usize,
    /// The claimants of each resource.
    pub(crate) resources: Vec<Vec<(Part, Holder)>>,
    /// The parts that violate each rule.
    pub(crate) rules: Vec<Vec<Part>>,
}

/// Whether two devices with these holders may hold the same thing.
pub(crate) const fn agree(one: Holder, other: Holder) -> bool {
    one == other && one != 0
}

/// The numbers of all names.
#[derive(Default)]
struct Names<'a> {
    boards: BTreeMap<&'a str, usize>,
    pins: BTreeMap<&'a str, usize>,
    users: BTreeMap<&'a str, usize>,
    resources: BTreeMap<&'a str, usize>,
    holders: BTreeMap<&'a str, usize>,
    signals: BTreeMap<&'a str, usize>,
    rules: BTreeMap<&'a str, usize>,
    streams: BTreeMap<&'a str, usize>,
}

/// The number that was given to a name.
fn number(names: &BTreeMap<&str, usize>, name: &str) -> usize {
    names.get(name).copied().unwrap_or(0)
}

fn keys<T>(map: &Map<T>) -> impl Iterator<Item = &str> {
    map.keys().map(String::as_str)
}

/// Numbers names in their order.
fn numbered<'a>(names: impl Iterator<Item = &'a str>) -> BTreeMap<&'a str, usize> {
    let sorted: BTreeSet<&str> = names.collect();
    sorted.into_iter().zip(0..).collect()
}

impl<'a> Names<'a> {
    fn new(problem: &'a Problem) -> Self {
        let ways = || problem.devices.values().flat_map(|device| device.values());
        let wires = || ways().flat_map(|way| way.roles.values()).flat_map(|role| role.values());
        let claims = || {
            let of_ways = ways().map(|way| &way.claims);
            of_ways.chain(wires().map(|wire| &wire.claims)).flat_map(|claims| claims.iter())
        };
        let violated = ways().map(|way| &way.violates).chain(wires().map(|wire| &wire.violates));
        let groups = claims().map(|(_, holder)| holder).chain(wires().map(|wire| &wire.holder));
        let groups = groups.map(String::as_str).filter(|holder| *holder != OWN);
        let mut holders = numbered(groups);
        holders.values_mut().for_each(|number| *number += 1);
        holders.insert(OWN, 0);
        Self {
            boards: numbered(keys(&problem.boards)),
            pins: numbered(keys(&problem.pins)),
            users: numbered(keys(&problem.dma)),
            resources: numbered(claims().map(|(name, _)| name.as_str())),
            holders,
            signals: numbered(wires().map(|wire| wire.signal.as_str())),
            rules: numbered(violated.flatten().map(String::as_str)),
            streams: numbered(problem.dma.values().flatten().flatten().map(String::as_str)),
        }
    }

    fn claims(&self, claims: &Map<String>, contested: &[bool]) -> Vec<Claim> {
        let claim = |(name, holder): (&String, &String)| Claim {
            resource: number(&self.resources, name),
            holder: number(&self.holders, holder),
            first: true,
        };
        claims.iter().map(claim).filter(|claim| contested[claim.resource]).collect()
    }

    fn rules(&self, violated: &BTreeSet<String>) -> Vec<usize> {
        violated.iter().map(|rule| number(&self.rules, rule)).collect()
    }

    /// The resources over which two devices can be in conflict. The others exclude nothing.
    fn contested(&self, problem: &Problem) -> Vec<bool> {
        let mut first: Vec<Option<(usize, usize)>> = vec![None; self.resources.len()];
        let mut contested = vec![false; self.resources.len()];
        for (device, ways) in problem.devices.values().enumerate() {
            for way in ways.values() {
                let wires = way.roles.values().flat_map(|role| role.values());
                let claims = wires.flat_map(|wire| wire.claims.iter()).chain(way.claims.iter());
                for (name, holder) in claims {
                    let (at, holder) =
                        (number(&self.resources, name), number(&self.holders, holder));
                    match first[at] {
                        None => first[at] = Some((device, holder)),
                        Some((one, held)) if one == device => {
                            // A device with two holders cannot share.
                            first[at] = Some((one, if held == holder { held } else { 0 }));
                        }
                        Some((_, held)) => contested[at] |= !agree(held, holder),
                    }
                }
            }
        }
        contested
    }
}

impl Statement {
    pub(crate) fn new(problem: &Problem) -> Self {
        let names = Names::new(problem);
        let contested = names.contested(problem);
        let pin = |(name, cost): (&String, &u32)| Pin {
            cost: *cost,
            shared: problem.shared.contains(name),
            wires: Vec::new(),
        };
        let request = |streams: &BTreeSet<String>| {
            streams.iter().map(|stream| number(&names.streams, stream)).collect()
        };
        let mut statement = Self {
            pins: problem.pins.iter().map(pin).collect(),
            spare: problem.boards.values().copied().collect(),
            users: problem.dma.values().map(|all| all.iter().map(request).collect()).collect(),
            streams: names.streams.len(),
            holders: names.holders.len(),
            resources: vec![Vec::new(); names.resources.len()],
            rules: vec![Vec::new(); names.rules.len()],
            ..Self::default()
        };
        for (device, ways) in problem.devices.values().enumerate() {
            let first = statement.ways.len();
            for way in ways.values() {
                statement.add_way(&names, &contested, device, way);
            }
            statement.devices.push(first..statement.ways.len());
        }
        statement.find_users();
        statement.find_roles();
        statement
    }

    fn add_way(&mut self, names: &Names<'_>, contested: &[bool], device: usize, of: &Alternative) {
        let way = self.ways.len();
        let first = self.roles.len();
        let claims = names.claims(&of.claims, contested);
        let mut before: BTreeSet<usize> = claims.iter().map(|claim| claim.resource).collect();
        for candidates in of.roles.values() {
            let role = self.roles.len();
            let start = self.wires.len();
            for Candidate { pin, holder, signal, claims, violates, moved } in candidates.values() {
                let mut claims = names.claims(claims, contested);
                claims.iter_mut().for_each(|one| one.first = !before.contains(&one.resource));
                self.wires.push(Wire {
                    role,
                    way,
                    device,
                    pin: number(&names.pins, pin),
                    holder: number(&names.holders, holder),
                    signal: number(&names.signals, signal),
                    moved: *moved,
                    claims,
                    rules: names.rules(violates),
                });
            }
            let added = self.wires[start..].iter().flat_map(|wire| &wire.claims);
            before.extend(added.map(|claim| claim.resource));
            let wires = start..self.wires.len();
            self.roles.push(Role { way, wires, own: true, ties: Vec::new() });
        }
        self.ways.push(Way {
            device,
            board: number(&names.boards, &of.board),
            claims,
            rules: names.rules(&of.violates),
            implied: BTreeSet::new(),
            users: of.dma.iter().map(|user| number(&names.users, user)).collect(),
            roles: first..self.roles.len(),
        });
    }

    fn find_users(&mut self) {
        for (number, way) in self.ways.iter().enumerate() {
            for claim in &way.claims {
                self.resources[claim.resource].push((Part::Way(number), claim.holder));
            }
            way.rules.iter().for_each(|rule| self.rules[*rule].push(Part::Way(number)));
        }
        for (number, wire) in self.wires.iter().enumerate() {
            self.pins[wire.pin].wires.push(number);
            for claim in &wire.claims {
                self.resources[claim.resource].push((Part::Wire(number), claim.holder));
            }
            wire.rules.iter().for_each(|rule| self.rules[*rule].push(Part::Wire(number)));
        }
    }

    fn find_roles(&mut self) {
        // The devices of a place: one, or several.
        let mut holders: BTreeMap<(usize, usize, usize), (usize, bool)> = BTreeMap::new();
        for wire in self.wires.iter().filter(|wire| wire.holder != 0) {
            let entry = holders.entry(wire.place()).or_insert((wire.device, true));
            entry.1 &= entry.0 == wire.device;
        }
        for role in &mut self.roles {
            let wires = &self.wires[role.wires.clone()];
            let alone = |wire: &Wire| wire.holder == 0 || holders[&wire.place()].1;
            role.own = wires.iter().all(alone);
            let groups = |wire: &Wire| -> BTreeSet<usize> {
                let grouped = wire.claims.iter().filter(|claim| claim.holder != 0);
                grouped.map(|claim| claim.resource).collect()
            };
            let common = wires.iter().map(groups).reduce(|one, other| &one & &other);
            role.ties = common.unwrap_or_default().into_iter().collect();
            let violated = |wire: &Wire| wire.rules.iter().copied().collect::<BTreeSet<usize>>();
            let common = wires.iter().map(violated).reduce(|one, other| &one & &other);
            self.ways[role.way].implied.extend(common.unwrap_or_default());
        }
        for way in &mut self.ways {
            way.implied.retain(|rule| !way.rules.contains(rule));
        }
    }

    pub(crate) fn device_of(&self, part: Part) -> usize {
        match part {
            Part::Way(way) => self.ways[way].device,
            Part::Wire(wire) => self.wires[wire].device,
        }
    }
}

impl Wire {
    /// The properties on which devices that hold a pin together must agree.
    pub(crate) const fn place(&self) -> (usize, usize, usize) {
        (self.pin, self.holder, self.signal)
    }

    /// Whether two devices can have these wires in one wiring.
    pub(crate) fn fits(&self, other: &Self) -> bool {
        let pins = self.pin != other.pin
            || (agree(self.holder, other.holder) && self.signal == other.signal);
        pins && self.claims.iter().all(|claim| {
            let mut same = other.claims.iter().filter(|one| one.resource == claim.resource);
            same.all(|one| agree(one.holder, claim.holder))
        })
    }
}
