//! Domains: the choices that are still possible at a node of the search.
//!
//! Domains only shrink. Every change is recorded on a trail, so a search returns to an earlier
//! state by unwinding it. The consequences of a restriction are computed in [`propagate`].

mod propagate;
pub(crate) mod streams;

use crate::index::{AltId, CandId, FacilityId, IdVec, Ids, RoleId};
use crate::model::{Holding, Model};
use crate::problem::{BoardId, DeviceId, RuleId};

/// A cost that is paid once, however many choices cause it: a soft rule or a spare board.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Charge {
    /// May still be avoided.
    Open,
    /// Its weight is in `paid`.
    Paid,
    /// May not be violated or used.
    Closed,
}

#[derive(Clone, Copy, Debug)]
enum Event {
    Alt(AltId),
    Cand(CandId),
    Rule(RuleId, Charge),
    Board(BoardId, Charge),
    /// A facility was added to `opened`.
    Opened,
    /// Something was decided about the board.
    Touched(BoardId),
}

/// There is no answer here, or none below the limit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pruned;

/// The live ids in a range of consecutive ids.
#[derive(Clone, Copy, Debug, Default)]
struct LiveIds {
    number: usize,
    /// Exclusive or of the live ids; when only one is left, this is that id.
    xor: u32,
}

impl LiveIds {
    fn all(ids: impl Iterator<Item = u32>) -> Self {
        ids.fold(Self::default(), |all, id| Self { number: all.number + 1, xor: all.xor ^ id })
    }

    fn remove(&mut self, id: u32) {
        self.number -= 1;
        self.xor ^= id;
    }

    fn restore(&mut self, id: u32) {
        self.number += 1;
        self.xor ^= id;
    }

    fn only(self) -> Option<u32> {
        (self.number == 1).then_some(self.xor)
    }
}

/// The domains.
#[derive(Clone, Debug)]
pub(crate) struct Domains {
    has_alt: IdVec<AltId, bool>,
    has_cand: IdVec<CandId, bool>,
    device: IdVec<DeviceId, LiveIds>,
    role: IdVec<RoleId, LiveIds>,
    pub(crate) rule: IdVec<RuleId, Charge>,
    pub(crate) board: IdVec<BoardId, Charge>,
    /// Weight of the rules and spare boards that are certain.
    pub(crate) paid: u64,
    /// Facilities (see [`crate::bounds::dualized`]) that at least one device must use.
    pub(crate) opened: Vec<FacilityId>,
    /// Boards about which something has been decided that has not been decided about all equal
    /// boards. Consequences of decisions do not count.
    touched: IdVec<BoardId, bool>,
    trail: Vec<Event>,
    /// Devices and roles with one choice left that propagation has not processed yet.
    decided: Vec<DeviceId>,
    chosen: Vec<RoleId>,
}

impl Domains {
    pub(crate) fn new(model: &Model) -> Result<Self, Pruned> {
        let alts = |d| LiveIds::all(model.alts.of(d).iter().map(|alt| alt.0));
        let cands = |r| LiveIds::all(model.cands.of(r).iter().map(|id| id.0));
        let roles = model.role_alt.ids();
        let mut domains = Self {
            has_alt: IdVec::same(true, model.alt_device.len()),
            has_cand: IdVec::same(true, model.cand.len()),
            device: model.devices.iter().map(alts).collect(),
            role: roles.iter().map(cands).collect(),
            rule: IdVec::same(Charge::Open, model.rule_users.len()),
            board: IdVec::same(Charge::Open, model.spare.len()),
            paid: 0,
            opened: Vec::new(),
            touched: IdVec::same(false, model.spare.len()),
            trail: Vec::new(),
            decided: Vec::new(),
            chosen: Vec::new(),
        };
        for device in model.devices {
            match domains.device[device].number {
                0 => return Err(Pruned),
                1 => domains.decided.push(device),
                _ => {}
            }
        }
        for role in roles {
            let alt = model.role_alt[role];
            if domains.role[role].number == 0 && domains.has_alt[alt] {
                domains.remove_alt(model, alt)?;
            }
        }
        domains.propagate(model)?;
        Ok(domains)
    }

    #[inline]
    pub(crate) fn has_alt(&self, alt: AltId) -> bool {
        self.has_alt[alt]
    }

    #[inline]
    pub(crate) fn has_cand(&self, model: &Model, id: CandId) -> bool {
        self.has_cand[id] && self.has_alt[model.cand_alt(id)]
    }

    /// The alternative of a device, when only one is left.
    #[inline]
    pub(crate) fn decided(&self, device: DeviceId) -> Option<AltId> {
        self.device[device].only().map(AltId)
    }

    /// The candidate of a role, when only one is left.
    #[inline]
    pub(crate) fn chosen(&self, role: RoleId) -> Option<CandId> {
        self.role[role].only().map(CandId)
    }

    /// Number of candidates that a role has left.
    pub(crate) fn cands_left(&self, role: RoleId) -> usize {
        self.role[role].number
    }

    /// Number of alternatives that a device has left.
    pub(crate) fn alts_left(&self, device: DeviceId) -> usize {
        self.device[device].number
    }

    pub(crate) fn alts<'a>(
        &'a self,
        model: &'a Model,
        device: DeviceId,
    ) -> impl Iterator<Item = AltId> + Clone + 'a {
        model.alts.of(device).iter().filter(|&a| self.has_alt[a])
    }

    /// The live candidates of a role whose alternative is known to be live.
    pub(crate) fn cands<'a>(
        &'a self,
        model: &'a Model,
        role: RoleId,
    ) -> impl Iterator<Item = CandId> + Clone + 'a {
        model.cands.of(role).iter().filter(|&c| self.has_cand[c])
    }

    /// Whether two interchangeable devices have the same choices left.
    pub(crate) fn same_domain(&self, model: &Model, one: DeviceId, other: DeviceId) -> bool {
        let (a, b) = (model.alts.of(one), model.alts.of(other));
        self.alts_left(one) == self.alts_left(other)
            && a.iter().zip(b).all(|(a, b)| {
                self.has_alt[a] == self.has_alt[b]
                    && (!self.has_alt[a]
                        || self.same_cands(model, model.roles.of(a), model.roles.of(b)))
            })
    }

    fn same_cands(&self, model: &Model, one: Ids<RoleId>, other: Ids<RoleId>) -> bool {
        one.iter().zip(other).all(|(r, s)| {
            let mut cands = model.cands.of(r).iter().zip(model.cands.of(s));
            self.cands_left(r) == self.cands_left(s)
                && cands.all(|(c, d)| self.has_cand[c] == self.has_cand[d])
        })
    }

    pub(crate) fn mark(&self) -> usize {
        self.trail.len()
    }

    /// Undoes everything since the mark.
    pub(crate) fn undo(&mut self, model: &Model, mark: usize) {
        self.decided.clear();
        self.chosen.clear();
        while self.trail.len() > mark {
            match self.trail.pop() {
                Some(Event::Alt(alt)) => {
                    self.has_alt[alt] = true;
                    self.device[model.alt_device[alt]].restore(alt.0);
                }
                Some(Event::Cand(id)) => {
                    self.has_cand[id] = true;
                    self.role[model.cand[id].role].restore(id.0);
                }
                Some(Event::Rule(rule, old)) => {
                    if self.rule[rule] == Charge::Paid && old != Charge::Paid {
                        self.paid -= model.weights.rule;
                    }
                    self.rule[rule] = old;
                }
                Some(Event::Board(board, old)) => {
                    if self.board[board] == Charge::Paid && old != Charge::Paid {
                        self.paid -= 1;
                    }
                    self.board[board] = old;
                }
                Some(Event::Opened) => {
                    self.opened.pop();
                }
                Some(Event::Touched(board)) => self.touched[board] = false,
                None => {}
            }
        }
    }

    pub(crate) fn remove_alt(&mut self, model: &Model, alt: AltId) -> Result<(), Pruned> {
        if !self.has_alt[alt] {
            return Ok(());
        }
        let device = model.alt_device[alt];
        self.has_alt[alt] = false;
        self.device[device].remove(alt.0);
        self.trail.push(Event::Alt(alt));
        match self.alts_left(device) {
            0 => Err(Pruned),
            1 => {
                self.decided.push(device);
                Ok(())
            }
            _ => Ok(()),
        }
    }

    pub(crate) fn remove_cand(&mut self, model: &Model, id: CandId) -> Result<(), Pruned> {
        let role = model.cand[id].role;
        let alt = model.role_alt[role];
        if !self.has_cand[id] || !self.has_alt[alt] {
            return Ok(());
        }
        self.has_cand[id] = false;
        self.role[role].remove(id.0);
        self.trail.push(Event::Cand(id));
        if self.cands_left(role) == 0 {
            return self.remove_alt(model, alt);
        }
        if self.alts_left(model.alt_device[alt]) == 1 {
            if self.cands_left(role) == 1 {
                self.chosen.push(role);
            }
            if let Holding::Wire(wire) = model.holding[role] {
                self.remove_on_wire(model, wire, id)?;
            }
        }
        Ok(())
    }

    /// Leaves the device only this alternative.
    pub(crate) fn choose_alt(&mut self, model: &Model, alt: AltId) -> Result<(), Pruned> {
        for other in model.alts.of(model.alt_device[alt]) {
            if other != alt {
                self.remove_alt(model, other)?;
            }
        }
        if self.has_alt[alt] { Ok(()) } else { Err(Pruned) }
    }

    /// Leaves the device only this candidate's alternative, and the role only this candidate.
    pub(crate) fn choose_cand(&mut self, model: &Model, id: CandId) -> Result<(), Pruned> {
        self.choose_alt(model, model.cand_alt(id))?;
        for other in model.cands.of(model.cand[id].role) {
            if other != id {
                self.remove_cand(model, other)?;
            }
        }
        if self.has_cand[id] { Ok(()) } else { Err(Pruned) }
    }

    pub(crate) fn pay_rule(&mut self, model: &Model, rule: RuleId) -> Result<(), Pruned> {
        match self.rule[rule] {
            Charge::Open if !model.rule_local[rule] => {
                self.trail.push(Event::Rule(rule, Charge::Open));
                self.rule[rule] = Charge::Paid;
                self.paid += model.weights.rule;
                Ok(())
            }
            Charge::Open | Charge::Paid => Ok(()),
            Charge::Closed => Err(Pruned),
        }
    }

    pub(crate) fn close_rule(&mut self, model: &Model, rule: RuleId) -> Result<(), Pruned> {
        match self.rule[rule] {
            Charge::Paid => return Err(Pruned),
            Charge::Closed => return Ok(()),
            Charge::Open => {}
        }
        self.trail.push(Event::Rule(rule, Charge::Open));
        self.rule[rule] = Charge::Closed;
        model.rule_users[rule].iter().try_for_each(|part| self.remove_part(model, *part))
    }

    pub(crate) fn pay_board(&mut self, model: &Model, board: BoardId) -> Result<(), Pruned> {
        match self.board[board] {
            Charge::Open if model.spare[board] => {
                self.trail.push(Event::Board(board, Charge::Open));
                self.board[board] = Charge::Paid;
                self.paid += 1;
                Ok(())
            }
            Charge::Open | Charge::Paid => Ok(()),
            Charge::Closed => Err(Pruned),
        }
    }

    pub(crate) fn close_board(&mut self, model: &Model, board: BoardId) -> Result<(), Pruned> {
        self.trail.push(Event::Board(board, self.board[board]));
        self.board[board] = Charge::Closed;
        model.board_alts[board].iter().try_for_each(|alt| self.remove_alt(model, *alt))
    }

    /// Restricts the search to answers in which at least one device uses the facility.
    pub(crate) fn open(&mut self, facility: FacilityId) {
        self.trail.push(Event::Opened);
        self.opened.push(facility);
    }

    /// Notes that something was decided about the board.
    pub(crate) fn touch(&mut self, board: BoardId) {
        if !std::mem::replace(&mut self.touched[board], true) {
            self.trail.push(Event::Touched(board));
        }
    }

    pub(crate) fn is_touched(&self, board: BoardId) -> bool {
        self.touched[board]
    }
}
