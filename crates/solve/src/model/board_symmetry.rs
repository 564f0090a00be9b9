//! Board symmetry: finds, for each board, the first board that is equal to it.
//!
//! Two boards are equal when every device has the same choices on both, with pins, resources and
//! streams numbered in the order in which they appear on each board. Swapping everything on them
//! then gives an answer with the same objective. The search uses this twice: it refuses a choice on
//! all equal boards about which nothing has been decided yet, and it tries only the first of them.

use crate::index::{AltId, CandId, Id, IdVec};
use crate::model::Model;
use crate::problem::{
    BoardId, Claim, DmaUserId, Holder, PinId, Problem, ResourceId, RuleId, StreamId,
};
use std::collections::BTreeMap;

/// Which boards are equal, and what corresponds to what.
#[derive(Clone, Debug, Default)]
pub(crate) struct BoardSymmetry {
    /// For each board the first that is equal to it.
    pub(crate) first_equal: IdVec<BoardId, BoardId>,
    /// Position of each alternative among those of its device on the same board.
    place: IdVec<AltId, usize>,
}

impl BoardSymmetry {
    pub(crate) fn new(problem: &Problem, model: &Model) -> Self {
        let boards = model.spare.ids();
        let mut first_equal: IdVec<BoardId, BoardId> = boards.iter().collect();
        let mut place = IdVec::same(0, model.alt_device.len());
        for device in model.devices {
            let mut next: IdVec<BoardId, usize> = IdVec::same(0, boards.len());
            for alt in model.alts.of(device) {
                let board = model.alt_board[alt];
                place[alt] = next[board];
                next[board] += 1;
            }
        }
        if boards.len() < 2 {
            return Self { first_equal, place };
        }
        let sites = Sites::new(problem, model);
        let signatures: IdVec<BoardId, Vec<u64>> =
            boards.iter().map(|board| Signature::of(problem, model, &sites, board)).collect();
        for board in boards.iter().skip(1) {
            let equal = |&b: &BoardId| first_equal[b] == b && signatures[b] == signatures[board];
            let first = boards.iter().take(board.index()).find(equal);
            first_equal[board] = first.unwrap_or(board);
        }
        Self { first_equal, place }
    }

    /// The alternative that corresponds to this one on an equal board.
    pub(crate) fn alt_on(&self, model: &Model, alt: AltId, board: BoardId) -> Option<AltId> {
        let mut alts = model.alts.of(model.alt_device[alt]).iter();
        alts.find(|&other| model.alt_board[other] == board && self.place[other] == self.place[alt])
    }

    /// The candidate that corresponds to this one on an equal board.
    pub(crate) fn cand_on(&self, model: &Model, id: CandId, board: BoardId) -> Option<CandId> {
        Some(model.twin_cand(id, self.alt_on(model, model.cand_alt(id), board)?))
    }
}

/// The board on which each resource, group, DMA user and stream is used.
struct Sites {
    resources: IdVec<ResourceId, Site>,
    groups: BTreeMap<u32, Site>,
    users: IdVec<DmaUserId, Site>,
    streams: IdVec<StreamId, Site>,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Site {
    Unused,
    On(BoardId),
    Several,
}

impl Site {
    fn add(&mut self, board: BoardId) {
        *self = match *self {
            Self::Unused => Self::On(board),
            Self::On(one) if one == board => Self::On(one),
            Self::On(_) | Self::Several => Self::Several,
        };
    }
}

impl Sites {
    fn new(problem: &Problem, model: &Model) -> Self {
        let mut sites = Self {
            resources: IdVec::same(Site::Unused, problem.resources as usize),
            groups: BTreeMap::new(),
            users: IdVec::same(Site::Unused, problem.dma.len()),
            streams: IdVec::same(Site::Unused, problem.streams as usize),
        };
        for (alt, &board) in model.alt_board.enumerate() {
            let of_cands = model.alt_cands(alt).iter().flat_map(|id| &model.cand_claims[id]);
            for claim in model.alt_claims[alt].iter().chain(of_cands) {
                sites.resources[claim.resource].add(board);
                sites.add_group(claim.holder, board);
            }
            for id in model.alt_cands(alt) {
                sites.add_group(model.cand[id].holder, board);
            }
            for &user in &model.alt_dma[alt] {
                sites.users[user].add(board);
                let requests = problem.dma_user(user).requests.iter();
                requests.flat_map(|r| &r.streams).for_each(|&s| sites.streams[s].add(board));
            }
        }
        sites
    }

    fn add_group(&mut self, holder: Holder, board: BoardId) {
        if let Holder::Group(number) = holder {
            self.groups.entry(number).or_insert(Site::Unused).add(board);
        }
    }
}

/// A board described in numbers that are the same for equal boards.
struct Signature<'a> {
    sites: &'a Sites,
    /// Numbers of things, in order of first appearance.
    names: BTreeMap<Numbered, u64>,
    text: Vec<u64>,
}

#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Numbered {
    Resource(ResourceId),
    Group(u32),
    User(DmaUserId),
    Stream(StreamId),
}

impl<'a> Signature<'a> {
    fn of(problem: &Problem, model: &Model, sites: &'a Sites, board: BoardId) -> Vec<u64> {
        let mut signature = Self { sites, names: BTreeMap::new(), text: Vec::new() };
        signature.text.push(u64::from(model.spare[board]));
        let alts = &model.board_alts[board];
        let cands = alts.iter().flat_map(|&alt| model.alt_cands(alt));
        let first = cands.map(|id| model.cand[id].pin).min().unwrap_or(PinId(0));
        for &alt in alts {
            let roles = model.roles.of(alt);
            signature.text.extend([u64::from(model.alt_device[alt].0), roles.len() as u64]);
            signature.claims(&model.alt_claims[alt]);
            signature.rules(&model.alt_rules[alt]);
            signature.text.push(model.alt_dma[alt].len() as u64);
            model.alt_dma[alt].iter().for_each(|&user| signature.user(problem, user));
            for role in roles {
                signature.text.push(model.cands.of(role).len() as u64);
                for id in model.cands.of(role) {
                    let c = &model.cand[id];
                    let pin = [u64::from(c.pin.0 - first.0), model.pin_weight[c.pin]];
                    signature.text.extend(pin);
                    signature.text.extend([u64::from(c.signal.0), u64::from(c.moved), c.extra]);
                    signature.holder(c.holder);
                    signature.claims(&model.cand_claims[id]);
                    signature.rules(&model.cand_rules[id]);
                }
            }
        }
        signature.text
    }

    fn rules(&mut self, rules: &[RuleId]) {
        self.text.push(rules.len() as u64);
        self.text.extend(rules.iter().map(|rule| u64::from(rule.0)));
    }

    fn claims(&mut self, claims: &[Claim]) {
        self.text.push(claims.len() as u64);
        for &Claim { resource, holder } in claims {
            let site = self.sites.resources[resource];
            self.name(Numbered::Resource(resource), u64::from(resource.0), site);
            if site != Site::Several {
                self.holder(holder);
                continue;
            }
            // On a resource of several boards, equal boards must have the same groups, or each a
            // group of its own: a chip is on one board or on the other.
            match holder {
                Holder::Group(number) if self.is_of_one_board(number) => {
                    self.text.push(u64::MAX - 1);
                    self.holder(holder);
                }
                Holder::Group(number) => self.text.push(u64::from(number) + 1),
                Holder::Own => self.text.push(0),
            }
        }
    }

    fn is_of_one_board(&self, group: u32) -> bool {
        matches!(self.sites.groups.get(&group), Some(Site::On(_)))
    }

    /// [`Holder::Own`] is the same on every board.
    fn holder(&mut self, holder: Holder) {
        match holder {
            Holder::Own => self.text.push(u64::MAX),
            Holder::Group(number) => {
                self.name(Numbered::Group(number), u64::from(number), Site::Unused);
            }
        }
    }

    fn user(&mut self, problem: &Problem, user: DmaUserId) {
        self.name(Numbered::User(user), u64::from(user.0), self.sites.users[user]);
        let requests = &problem.dma_user(user).requests;
        self.text.push(requests.len() as u64);
        for request in requests {
            self.text.push(request.streams.len() as u64);
            for &stream in &request.streams {
                let site = self.sites.streams[stream];
                self.name(Numbered::Stream(stream), u64::from(stream.0), site);
            }
        }
    }

    /// Appends the number of a thing on this board. A thing that other boards have too is marked
    /// and keeps its own number.
    fn name(&mut self, thing: Numbered, own: u64, site: Site) {
        let next = self.names.len() as u64;
        let shared = site == Site::Several;
        let name = if shared { own } else { *self.names.entry(thing).or_insert(next) };
        self.text.extend([u64::from(shared), name]);
    }
}
