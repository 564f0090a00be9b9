//! Symmetry of boards: a model in, the first equal board of each board out.
//!
//! Two boards are equal when every device has the same choices on both, with pins, resources and
//! streams numbered in the order in which they appear on each board. Swapping all that is on them
//! then gives an answer with the same objective. The search uses this twice: it refuses a choice on
//! all equal boards about which nothing is decided yet, and it tries only the first of them.
#![expect(clippy::indexing_slicing, reason = "all ids come from the model")]

use crate::model::Model;
use crate::problem::Problem;
use std::collections::BTreeMap;

/// Which boards are equal, and what corresponds to what.
#[derive(Clone, Debug, Default)]
pub(crate) struct Boards {
    /// For each board the first that is equal to it.
    pub(crate) first_equal: Vec<usize>,
    /// Place of each alternative among those of its device on its board.
    place: Vec<usize>,
}

impl Boards {
    pub(crate) fn new(problem: &Problem, model: &Model) -> Self {
        let boards = model.spare.len();
        let mut first_equal: Vec<usize> = (0..boards).collect();
        let mut place = vec![0; model.alt_device.len()];
        for device in 0..model.devices {
            let mut next = vec![0; boards];
            for alt in model.alts.range(device) {
                let board = model.alt_board[alt];
                place[alt] = next[board];
                next[board] += 1;
            }
        }
        if boards < 2 {
            return Self { first_equal, place };
        }
        let homes = Sites::new(problem, model);
        let looks: Vec<Vec<u64>> =
            (0..boards).map(|board| Signature::of(problem, model, &homes, board)).collect();
        for board in 1..boards {
            let equal = |b: &usize| first_equal[*b] == *b && looks[*b] == looks[board];
            first_equal[board] = (0..board).find(equal).unwrap_or(board);
        }
        Self { first_equal, place }
    }

    /// What the alternative is on an equal board.
    pub(crate) fn alt_on(&self, model: &Model, alt: usize, board: usize) -> Option<usize> {
        let mut alts = model.alts.range(model.alt_device[alt]);
        alts.find(|&other| model.alt_board[other] == board && self.place[other] == self.place[alt])
    }

    /// What the candidate is on an equal board.
    pub(crate) fn cand_on(&self, model: &Model, id: usize, board: usize) -> Option<usize> {
        let role = model.cand(id).role;
        let alt = model.role_alt[role];
        let other = self.alt_on(model, alt, board)?;
        let position = role - model.roles.range(alt).start;
        let place = id - model.cands.range(role).start;
        Some(model.cands.range(model.roles.range(other).start + position).start + place)
    }
}

/// Whose each resource, DMA user and stream is.
struct Sites {
    resources: Vec<Site>,
    users: Vec<Site>,
    streams: Vec<Site>,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Site {
    Unused,
    On(usize),
    Several,
}

impl Site {
    fn add(&mut self, board: usize) {
        *self = match *self {
            Self::Unused => Self::On(board),
            Self::On(one) if one == board => Self::On(one),
            Self::On(_) | Self::Several => Self::Several,
        };
    }
}

impl Sites {
    fn new(problem: &Problem, model: &Model) -> Self {
        let mut resources = vec![Site::Unused; problem.resources as usize];
        let mut users = vec![Site::Unused; problem.dma.len()];
        let mut streams = vec![Site::Unused; problem.streams as usize];
        for alt in 0..model.alt_device.len() {
            let board = model.alt_board[alt];
            let cands = model.roles.range(alt).flat_map(|role| model.cands.range(role));
            let of_cands = cands.flat_map(|id| model.cand_claims.at(id));
            for claim in model.alt_claims.at(alt).iter().chain(of_cands) {
                resources[claim.0].add(board);
            }
            for &user in model.alt_dma.at(alt) {
                users[user].add(board);
                let requests = problem.dma[user].requests.iter();
                requests.flat_map(|r| &r.streams).for_each(|s| streams[s.0 as usize].add(board));
            }
        }
        Self { resources, users, streams }
    }
}

/// What a board looks like, in numbers that are the same for equal boards.
struct Signature<'a> {
    homes: &'a Sites,
    /// Numbers of things in the order in which they come.
    names: BTreeMap<(Thing, usize), u64>,
    text: Vec<u64>,
}

#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Thing {
    Resource,
    Group,
    User,
    Stream,
}

impl<'a> Signature<'a> {
    fn of(problem: &Problem, model: &Model, homes: &'a Sites, board: usize) -> Vec<u64> {
        let mut look = Self { homes, names: BTreeMap::new(), text: Vec::new() };
        look.text.push(u64::from(model.spare[board]));
        let alts = model.board_alts.at(board);
        let pins = alts.iter().flat_map(|&alt| model.roles.range(alt));
        let first = pins.flat_map(|r| model.cands.at(r)).map(|c| c.pin).min().unwrap_or(0);
        for &alt in alts {
            look.text.extend([model.alt_device[alt] as u64, model.roles.range(alt).len() as u64]);
            look.claims(model.alt_claims.at(alt));
            look.numbers(model.alt_rules.at(alt));
            look.text.push(model.alt_dma.at(alt).len() as u64);
            model.alt_dma.at(alt).iter().for_each(|&user| look.user(problem, user));
            for role in model.roles.range(alt) {
                look.text.push(model.cands.range(role).len() as u64);
                for id in model.cands.range(role) {
                    let c = *model.cand(id);
                    let pin = [(c.pin - first) as u64, model.pin_weight[c.pin]];
                    look.text.extend(pin);
                    look.text.extend([c.signal as u64, u64::from(c.moved), c.extra]);
                    look.group(c.holder);
                    look.claims(model.cand_claims.at(id));
                    look.numbers(model.cand_rules.at(id));
                }
            }
        }
        look.text
    }

    fn numbers(&mut self, numbers: &[usize]) {
        self.text.push(numbers.len() as u64);
        self.text.extend(numbers.iter().map(|&number| number as u64));
    }

    fn claims(&mut self, claims: &[(usize, usize)]) {
        self.text.push(claims.len() as u64);
        for &(resource, holder) in claims {
            let home = self.homes.resources[resource];
            self.named(Thing::Resource, resource, home);
            // Of what several boards have, all must mean the same by a group.
            if home == Site::Several {
                self.text.push(holder as u64);
            } else {
                self.group(holder);
            }
        }
    }

    /// 0 is the device alone on every board.
    fn group(&mut self, holder: usize) {
        if holder == 0 {
            self.text.push(u64::MAX);
        } else {
            self.named(Thing::Group, holder, Site::Unused);
        }
    }

    fn user(&mut self, problem: &Problem, user: usize) {
        self.named(Thing::User, user, self.homes.users[user]);
        self.text.push(problem.dma[user].requests.len() as u64);
        for request in &problem.dma[user].requests {
            self.text.push(request.streams.len() as u64);
            for stream in &request.streams {
                let stream = stream.0 as usize;
                self.named(Thing::Stream, stream, self.homes.streams[stream]);
            }
        }
    }

    /// The number of a thing on this board; its own, and a mark, where other boards have it too.
    fn named(&mut self, thing: Thing, id: usize, home: Site) {
        let next = self.names.len() as u64;
        let shared = home == Site::Several;
        let name = if shared { id as u64 } else { *self.names.entry((thing, id)).or_insert(next) };
        self.text.extend([u64::from(shared), name]);
    }
}
