//! The choices that can still be taken in a case. They only shrink; every change is recorded on a
//! trail and undone when the case is left.
#![expect(clippy::indexing_slicing, reason = "places are checked where they are read")]

use super::statement::{Claim, Part, Statement, agree};
use std::collections::{BTreeMap, BTreeSet};

/// The most streams that are matched with requests; no board has as many.
const STREAMS_MAX: usize = 1000;

/// The state of a rule or a board.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Charge {
    /// May be violated, or used, or not.
    Open,
    /// Is violated, or used, in every wiring of the case.
    Paid,
    /// Is violated, or used, in no wiring of the case.
    Closed,
}

#[derive(Clone, Copy, Debug)]
enum Event {
    Way(usize),
    Wire(usize),
    Rule(usize, Charge),
    Board(usize, Charge),
    Opened(usize),
    Died,
}

/// The choices that are left.
#[derive(Debug)]
pub(crate) struct State {
    pub(crate) way: Vec<bool>,
    pub(crate) wire: Vec<bool>,
    /// The number of alternatives that each device has left, and of candidates that each role has
    /// left.
    ways_left: Vec<usize>,
    pub(crate) wires_left: Vec<usize>,
    pub(crate) rule: Vec<Charge>,
    pub(crate) board: Vec<Charge>,
    /// Facilities that at least one device uses in every wiring of the case.
    pub(crate) open: Vec<bool>,
    /// Whether nothing is left.
    pub(crate) dead: bool,
    trail: Vec<Event>,
    /// Devices with one alternative left that propagation still has to process.
    waiting: Vec<usize>,
    /// Number of choices examined, a measure of the time.
    pub(crate) work: usize,
}

impl State {
    /// The state in which everything is left.
    pub(crate) fn new(statement: &Statement, facilities: usize) -> Self {
        let mut state = Self {
            way: vec![true; statement.ways.len()],
            wire: vec![true; statement.wires.len()],
            ways_left: statement.devices.iter().map(ExactSizeIterator::len).collect(),
            wires_left: statement.roles.iter().map(|role| role.wires.len()).collect(),
            rule: vec![Charge::Open; statement.rules.len()],
            board: vec![Charge::Open; statement.spare.len()],
            open: vec![false; facilities],
            dead: false,
            trail: Vec::new(),
            waiting: (0..statement.devices.len()).collect(),
            work: 0,
        };
        state.dead = state.ways_left.contains(&0);
        for role in statement.roles.iter().filter(|role| role.wires.is_empty()) {
            state.remove_way(statement, role.way);
        }
        state
    }

    pub(crate) fn mark(&self) -> usize {
        self.trail.len()
    }

    /// Undoes everything after the mark.
    pub(crate) fn undo(&mut self, statement: &Statement, mark: usize) {
        self.waiting.clear();
        while self.trail.len() > mark {
            match self.trail.pop() {
                Some(Event::Way(way)) => {
                    self.way[way] = true;
                    self.ways_left[statement.ways[way].device] += 1;
                }
                Some(Event::Wire(wire)) => {
                    self.wire[wire] = true;
                    self.wires_left[statement.wires[wire].role] += 1;
                }
                Some(Event::Rule(rule, old)) => self.rule[rule] = old,
                Some(Event::Board(board, old)) => self.board[board] = old,
                Some(Event::Opened(facility)) => self.open[facility] = false,
                Some(Event::Died) => self.dead = false,
                None => {}
            }
        }
    }

    pub(crate) fn die(&mut self) {
        if !std::mem::replace(&mut self.dead, true) {
            self.trail.push(Event::Died);
        }
    }

    /// Whether a device has one alternative left.
    pub(crate) fn has_one(&self, device: usize) -> bool {
        self.ways_left[device] == 1
    }

    /// The only alternative that a device has left.
    pub(crate) fn decided(&self, statement: &Statement, device: usize) -> Option<usize> {
        if self.has_one(device) { self.ways(statement, device).next() } else { None }
    }

    /// The candidates that a role has left.
    pub(crate) fn wires<'s>(
        &'s self,
        statement: &'s Statement,
        role: usize,
    ) -> impl Iterator<Item = usize> + Clone + 's {
        statement.roles[role].wires.clone().filter(|wire| self.wire[*wire])
    }

    /// The alternatives that a device has left.
    pub(crate) fn ways<'s>(
        &'s self,
        statement: &'s Statement,
        device: usize,
    ) -> impl Iterator<Item = usize> + Clone + 's {
        statement.devices[device].clone().filter(|way| self.way[*way])
    }

    pub(crate) fn remove_way(&mut self, statement: &Statement, way: usize) {
        if std::mem::replace(&mut self.way[way], false) {
            let device = statement.ways[way].device;
            self.trail.push(Event::Way(way));
            self.ways_left[device] -= 1;
            match self.ways_left[device] {
                0 => self.die(),
                1 => self.waiting.push(device),
                _ => {}
            }
        }
    }

    pub(crate) fn remove_wire(&mut self, statement: &Statement, wire: usize) {
        if std::mem::replace(&mut self.wire[wire], false) {
            let role = statement.wires[wire].role;
            self.trail.push(Event::Wire(wire));
            self.wires_left[role] -= 1;
            let way = statement.roles[role].way;
            if self.wires_left[role] == 0 {
                self.remove_way(statement, way);
            } else if self.way[way] && self.ways_left[statement.ways[way].device] == 1 {
                self.waiting.push(statement.ways[way].device);
            }
        }
    }

    fn remove(&mut self, statement: &Statement, part: Part) {
        match part {
            Part::Way(way) => self.remove_way(statement, way),
            Part::Wire(wire) => self.remove_wire(statement, wire),
        }
    }

    pub(crate) fn keep_way(&mut self, statement: &Statement, way: usize) {
        let device = statement.ways[way].device;
        for other in statement.devices[device].clone().filter(|other| *other != way) {
            self.remove_way(statement, other);
        }
    }

    pub(crate) fn keep_wire(&mut self, statement: &Statement, wire: usize) {
        self.keep_way(statement, statement.wires[wire].way);
        let role = statement.wires[wire].role;
        for other in statement.roles[role].wires.clone().filter(|other| *other != wire) {
            self.remove_wire(statement, other);
        }
    }

    pub(crate) fn pay_rule(&mut self, rule: usize) {
        let old = std::mem::replace(&mut self.rule[rule], Charge::Paid);
        self.charged(old, Charge::Closed, Event::Rule(rule, old));
    }

    pub(crate) fn close_rule(&mut self, statement: &Statement, rule: usize) {
        let old = std::mem::replace(&mut self.rule[rule], Charge::Closed);
        self.charged(old, Charge::Paid, Event::Rule(rule, old));
        statement.rules[rule].iter().for_each(|part| self.remove(statement, *part));
    }

    pub(crate) fn use_board(&mut self, board: usize) {
        let old = std::mem::replace(&mut self.board[board], Charge::Paid);
        self.charged(old, Charge::Closed, Event::Board(board, old));
    }

    pub(crate) fn close_board(&mut self, statement: &Statement, board: usize) {
        let old = std::mem::replace(&mut self.board[board], Charge::Closed);
        self.charged(old, Charge::Paid, Event::Board(board, old));
        for (way, _) in statement.ways.iter().enumerate().filter(|(_, way)| way.board == board) {
            self.remove_way(statement, way);
        }
    }

    fn charged(&mut self, old: Charge, against: Charge, event: Event) {
        self.trail.push(event);
        if old == against {
            self.die();
        }
    }

    pub(crate) fn open(&mut self, facility: usize) {
        if !std::mem::replace(&mut self.open[facility], true) {
            self.trail.push(Event::Opened(facility));
        }
    }

    /// Removes everything that is excluded by devices with one alternative left and by roles with
    /// one candidate left.
    pub(crate) fn propagate(&mut self, statement: &Statement) {
        while let Some(device) = self.waiting.pop() {
            if self.dead {
                self.waiting.clear();
                return;
            }
            let Some(way) = self.decided(statement, device) else { continue };
            let of = &statement.ways[way];
            self.exclude(statement, device, &of.claims);
            of.rules.iter().for_each(|rule| self.pay_once(*rule));
            if self.board[of.board] != Charge::Paid {
                self.use_board(of.board);
            }
            for role in of.roles.clone() {
                match self.wires_left[role] {
                    1 => self.follow(statement, role),
                    _ => self.agree_on(statement, device, role),
                }
            }
        }
    }

    fn pay_once(&mut self, rule: usize) {
        if self.rule[rule] != Charge::Paid {
            self.pay_rule(rule);
        }
    }

    /// No other device can take these on another behalf.
    fn exclude(&mut self, statement: &Statement, device: usize, claims: &[Claim]) {
        for claim in claims {
            self.work += statement.resources[claim.resource].len();
            for (part, holder) in &statement.resources[claim.resource] {
                if !agree(*holder, claim.holder) && statement.device_of(*part) != device {
                    self.remove(statement, *part);
                }
            }
        }
    }

    /// The only candidate of a role excludes others.
    fn follow(&mut self, statement: &Statement, role: usize) {
        let Some(wire) = self.wires(statement, role).next() else { return };
        let of = &statement.wires[wire];
        self.exclude(statement, of.device, &of.claims);
        of.rules.iter().for_each(|rule| self.pay_once(*rule));
        self.work += statement.pins[of.pin].wires.len();
        for other in &statement.pins[of.pin].wires {
            let one = &statement.wires[*other];
            let clash = if one.device == of.device {
                one.role != role
            } else {
                !agree(one.holder, of.holder) || one.signal != of.signal
            };
            if clash {
                self.remove_wire(statement, *other);
            }
        }
    }

    /// Devices that share what this role takes in any case must fit one of its candidates.
    fn agree_on(&mut self, statement: &Statement, device: usize, role: usize) {
        let mut others = BTreeSet::new();
        for tie in &statement.roles[role].ties {
            for (part, _) in &statement.resources[*tie] {
                match part {
                    Part::Wire(wire) if statement.wires[*wire].device != device => {
                        others.insert(*wire);
                    }
                    Part::Way(_) | Part::Wire(_) => {}
                }
            }
        }
        for other in others {
            self.work += self.wires_left[role];
            let one = &statement.wires[other];
            let fits = |wire: usize| statement.wires[wire].fits(one);
            if self.wire[other] && !self.wires(statement, role).any(fits) {
                self.remove_wire(statement, other);
            }
        }
    }

    /// Whether there are streams for everything that certainly needs them: the users of DMA of
    /// devices that have one alternative left, and as many private ones as each other device needs
    /// whatever it takes.
    pub(crate) fn has_streams(&self, statement: &Statement, private: &[bool]) -> bool {
        let mut users = BTreeSet::new();
        let mut requests: Vec<BTreeSet<usize>> = Vec::new();
        if statement.streams > STREAMS_MAX {
            return true;
        }
        for device in 0..statement.devices.len() {
            if let Some(way) = self.decided(statement, device) {
                users.extend(statement.ways[way].users.iter().copied());
                continue;
            }
            let own = |way: usize| -> Vec<&BTreeSet<usize>> {
                let users = statement.ways[way].users.iter().filter(|user| private[**user]);
                users.flat_map(|user| &statement.users[*user]).collect()
            };
            let all: Vec<_> = self.ways(statement, device).map(own).collect();
            let least = all.iter().map(Vec::len).min().unwrap_or(0);
            requests.extend((0..least).map(|place| {
                let streams = all.iter().filter_map(|one| one.get(place));
                streams.flat_map(|one| one.iter().copied()).collect()
            }));
        }
        requests.extend(users.into_iter().flat_map(|user| statement.users[user].iter().cloned()));
        let mut taken: BTreeMap<usize, usize> = BTreeMap::new();
        (0..requests.len()).all(|one| serve(&requests, one, &mut taken, &mut BTreeSet::new()))
    }
}

/// Gives a request a stream of its own, moving others if needed.
fn serve(
    requests: &[BTreeSet<usize>],
    one: usize,
    taken: &mut BTreeMap<usize, usize>,
    seen: &mut BTreeSet<usize>,
) -> bool {
    requests[one].iter().any(|stream| {
        if !seen.insert(*stream) {
            return false;
        }
        let free = match taken.get(stream).copied() {
            None => true,
            Some(other) => serve(requests, other, taken, seen),
        };
        if free {
            taken.insert(*stream, one);
        }
        free
    })
}
