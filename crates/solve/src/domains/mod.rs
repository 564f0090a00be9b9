//! What is still possible: restrictions in, their consequences out, all of it undone on demand.
//!
//! Domains only shrink. Every change is written on a trail, so a search returns to an earlier
//! domains by unwinding it.
#![expect(clippy::indexing_slicing, reason = "all ids come from the model")]

pub(crate) mod streams;

use crate::model::{Kind, Model, agree};

/// A soft rule or a spare board, as far as decided.
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
    Alt(usize),
    Cand(usize),
    Rule(usize, Charge),
    Board(usize, Charge),
    /// The last of `opened`.
    Opened,
    /// Something is decided of the board.
    Touched(usize),
}

/// Nothing is left for some device or role.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Dead;

/// The domains.
#[derive(Clone, Debug)]
pub(crate) struct Domains {
    alt_on: Vec<bool>,
    cand_on: Vec<bool>,
    device_left: Vec<usize>,
    /// Exclusive or of the living ids, which is the id when one is left.
    device_mix: Vec<usize>,
    role_left: Vec<usize>,
    role_mix: Vec<usize>,
    pub(crate) rule: Vec<Charge>,
    pub(crate) board: Vec<Charge>,
    /// Weight of the rules and spare boards that are certain.
    pub(crate) paid: u64,
    /// Facilities (see [`crate::bounds::dualized`]) that somebody must use.
    pub(crate) opened: Vec<usize>,
    /// Boards of which something is decided that is not decided of all equal ones. What only
    /// follows does not count.
    touched: Vec<bool>,
    trail: Vec<Event>,
    decided: Vec<usize>,
    pinned: Vec<usize>,
}

impl Domains {
    pub(crate) fn new(model: &Model) -> Result<Self, Dead> {
        let mix = |range: std::ops::Range<usize>| range.fold(0, |a, b| a ^ b);
        let roles = model.role_alt.len();
        let mut domains = Self {
            alt_on: vec![true; model.alt_device.len()],
            cand_on: vec![true; model.cand_count()],
            device_left: (0..model.devices).map(|d| model.alts.range(d).len()).collect(),
            device_mix: (0..model.devices).map(|d| mix(model.alts.range(d))).collect(),
            role_left: (0..roles).map(|r| model.cands.range(r).len()).collect(),
            role_mix: (0..roles).map(|r| mix(model.cands.range(r))).collect(),
            rule: vec![Charge::Open; model.rule_users.len()],
            board: vec![Charge::Open; model.spare.len()],
            paid: 0,
            opened: Vec::new(),
            touched: vec![false; model.spare.len()],
            trail: Vec::new(),
            decided: Vec::new(),
            pinned: Vec::new(),
        };
        for device in 0..model.devices {
            match domains.device_left[device] {
                0 => return Err(Dead),
                1 => domains.decided.push(device),
                _ => {}
            }
        }
        for role in 0..roles {
            let alt = model.role_alt[role];
            if domains.role_left[role] == 0 && domains.alt_on[alt] {
                domains.kill_alt(model, alt)?;
            }
        }
        domains.propagate(model)?;
        Ok(domains)
    }

    pub(crate) fn alt_on(&self, alt: usize) -> bool {
        self.alt_on[alt]
    }

    pub(crate) fn cand_on(&self, model: &Model, id: usize) -> bool {
        self.cand_on[id] && self.alt_on[model.cand_alt(id)]
    }

    /// The alternative, when only one is left.
    pub(crate) fn decided(&self, device: usize) -> Option<usize> {
        (self.device_left[device] == 1).then(|| self.device_mix[device])
    }

    /// The candidate, when only one is left.
    pub(crate) fn pinned(&self, role: usize) -> Option<usize> {
        (self.role_left[role] == 1).then(|| self.role_mix[role])
    }

    pub(crate) fn role_left(&self, role: usize) -> usize {
        self.role_left[role]
    }

    pub(crate) fn device_left(&self, device: usize) -> usize {
        self.device_left[device]
    }

    pub(crate) fn alts<'a>(
        &'a self,
        model: &'a Model,
        device: usize,
    ) -> impl Iterator<Item = usize> + Clone + 'a {
        model.alts.range(device).filter(|&a| self.alt_on[a])
    }

    /// The living candidates of a role whose alternative is known to live.
    pub(crate) fn cands<'a>(
        &'a self,
        model: &'a Model,
        role: usize,
    ) -> impl Iterator<Item = usize> + Clone + 'a {
        model.cands.range(role).filter(|&c| self.cand_on[c])
    }

    /// Whether two interchangeable devices have the same choices left.
    pub(crate) fn same_domain(&self, model: &Model, one: usize, other: usize) -> bool {
        let (a, b) = (model.alts.range(one), model.alts.range(other));
        self.device_left[one] == self.device_left[other]
            && a.zip(b).all(|(a, b)| {
                if self.alt_on[a] != self.alt_on[b] {
                    return false;
                }
                let (r, s) = (model.roles.range(a), model.roles.range(b));
                !self.alt_on[a]
                    || r.zip(s).all(|(r, s)| {
                        let (c, d) = (model.cands.range(r), model.cands.range(s));
                        self.role_left[r] == self.role_left[s]
                            && c.zip(d).all(|(c, d)| self.cand_on[c] == self.cand_on[d])
                    })
            })
    }

    pub(crate) fn mark(&self) -> usize {
        self.trail.len()
    }

    pub(crate) fn undo(&mut self, model: &Model, mark: usize) {
        self.decided.clear();
        self.pinned.clear();
        while self.trail.len() > mark {
            match self.trail.pop() {
                Some(Event::Alt(alt)) => {
                    self.alt_on[alt] = true;
                    self.device_left[model.alt_device[alt]] += 1;
                    self.device_mix[model.alt_device[alt]] ^= alt;
                }
                Some(Event::Cand(id)) => {
                    self.cand_on[id] = true;
                    self.role_left[model.cand(id).role] += 1;
                    self.role_mix[model.cand(id).role] ^= id;
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

    pub(crate) fn kill_alt(&mut self, model: &Model, alt: usize) -> Result<(), Dead> {
        if !self.alt_on[alt] {
            return Ok(());
        }
        let device = model.alt_device[alt];
        self.alt_on[alt] = false;
        self.device_left[device] -= 1;
        self.device_mix[device] ^= alt;
        self.trail.push(Event::Alt(alt));
        match self.device_left[device] {
            0 => Err(Dead),
            1 => {
                self.decided.push(device);
                Ok(())
            }
            _ => Ok(()),
        }
    }

    pub(crate) fn kill_cand(&mut self, model: &Model, id: usize) -> Result<(), Dead> {
        let role = model.cand(id).role;
        let alt = model.role_alt[role];
        if !self.cand_on[id] || !self.alt_on[alt] {
            return Ok(());
        }
        self.cand_on[id] = false;
        self.role_left[role] -= 1;
        self.role_mix[role] ^= id;
        self.trail.push(Event::Cand(id));
        if self.role_left[role] == 0 {
            return self.kill_alt(model, alt);
        }
        if self.device_left[model.alt_device[alt]] == 1 {
            if self.role_left[role] == 1 {
                self.pinned.push(role);
            }
            if let Kind::Wire(wire) = model.role_kind[role] {
                self.kill_on_wire(model, wire, id)?;
            }
        }
        Ok(())
    }

    /// A decided device cannot take this candidate, so nobody on its wire can.
    fn kill_on_wire(&mut self, model: &Model, wire: usize, id: usize) -> Result<(), Dead> {
        let c = model.cand(id);
        for &other in model.wire_cands.at(wire) {
            let o = model.cand(other);
            if (o.pin, o.signal) == (c.pin, c.signal) {
                self.kill_cand(model, other)?;
            }
        }
        Ok(())
    }

    pub(crate) fn decide(&mut self, model: &Model, alt: usize) -> Result<(), Dead> {
        for other in model.alts.range(model.alt_device[alt]) {
            if other != alt {
                self.kill_alt(model, other)?;
            }
        }
        if self.alt_on[alt] { Ok(()) } else { Err(Dead) }
    }

    pub(crate) fn pin(&mut self, model: &Model, id: usize) -> Result<(), Dead> {
        self.decide(model, model.cand_alt(id))?;
        for other in model.cands.range(model.cand(id).role) {
            if other != id {
                self.kill_cand(model, other)?;
            }
        }
        if self.cand_on[id] { Ok(()) } else { Err(Dead) }
    }

    pub(crate) fn pay_rule(&mut self, model: &Model, rule: usize) -> Result<(), Dead> {
        match self.rule[rule] {
            Charge::Open if !model.rule_local[rule] => {
                self.trail.push(Event::Rule(rule, Charge::Open));
                self.rule[rule] = Charge::Paid;
                self.paid += model.weights.rule;
                Ok(())
            }
            Charge::Open | Charge::Paid => Ok(()),
            Charge::Closed => Err(Dead),
        }
    }

    pub(crate) fn close_rule(&mut self, model: &Model, rule: usize) -> Result<(), Dead> {
        if self.rule[rule] != Charge::Open {
            return if self.rule[rule] == Charge::Paid { Err(Dead) } else { Ok(()) };
        }
        self.trail.push(Event::Rule(rule, Charge::Open));
        self.rule[rule] = Charge::Closed;
        for user in model.rule_users.at(rule) {
            if user.is_candidate {
                self.kill_cand(model, user.id)?;
            } else {
                self.kill_alt(model, user.id)?;
            }
        }
        Ok(())
    }

    pub(crate) fn pay_board(&mut self, model: &Model, board: usize) -> Result<(), Dead> {
        match self.board[board] {
            Charge::Open if model.spare[board] => {
                self.trail.push(Event::Board(board, Charge::Open));
                self.board[board] = Charge::Paid;
                self.paid += 1;
                Ok(())
            }
            Charge::Open | Charge::Paid => Ok(()),
            Charge::Closed => Err(Dead),
        }
    }

    pub(crate) fn close_board(&mut self, model: &Model, board: usize) -> Result<(), Dead> {
        self.trail.push(Event::Board(board, self.board[board]));
        self.board[board] = Charge::Closed;
        for &alt in model.board_alts.at(board) {
            self.kill_alt(model, alt)?;
        }
        Ok(())
    }

    /// Only answers in which somebody uses the facility are looked for.
    pub(crate) fn open(&mut self, facility: usize) {
        self.trail.push(Event::Opened);
        self.opened.push(facility);
    }

    /// Says that something is decided of the board.
    pub(crate) fn touch(&mut self, board: usize) {
        if !std::mem::replace(&mut self.touched[board], true) {
            self.trail.push(Event::Touched(board));
        }
    }

    pub(crate) fn is_touched(&self, board: usize) -> bool {
        self.touched[board]
    }

    /// Follows every decision to its end.
    pub(crate) fn propagate(&mut self, model: &Model) -> Result<(), Dead> {
        loop {
            if let Some(device) = self.decided.pop() {
                let alt = self.device_mix[device];
                self.follow_alt(model, device, alt)?;
            } else if let Some(role) = self.pinned.pop() {
                self.follow_cand(model, self.role_mix[role])?;
            } else {
                return Ok(());
            }
        }
    }

    fn follow_alt(&mut self, model: &Model, device: usize, alt: usize) -> Result<(), Dead> {
        self.follow_claims(model, device, model.alt_claims.at(alt))?;
        for &rule in model.alt_rules.at(alt) {
            self.pay_rule(model, rule)?;
        }
        self.pay_board(model, model.alt_board[alt])?;
        for role in model.roles.range(alt) {
            if self.role_left[role] == 1 {
                self.pinned.push(role);
            }
            if let Kind::Wire(wire) = model.role_kind[role] {
                self.join_wire(model, role, wire)?;
            }
        }
        Ok(())
    }

    /// A device has come to a wire: nobody there can leave its candidates.
    fn join_wire(&mut self, model: &Model, role: usize, wire: usize) -> Result<(), Dead> {
        for &other in model.wire_cands.at(wire) {
            if !self.cand_on(model, other) {
                continue;
            }
            let o = model.cand(other);
            let here = |c: usize| {
                let c = model.cand(c);
                (c.pin, c.signal, c.holder) == (o.pin, o.signal, o.holder)
            };
            if o.role != role
                && model.cand_device(other) != model.alt_device[model.role_alt[role]]
                && !self.cands(model, role).any(here)
            {
                self.kill_cand(model, other)?;
            }
        }
        Ok(())
    }

    fn follow_claims(
        &mut self,
        model: &Model,
        device: usize,
        claims: &[(usize, usize)],
    ) -> Result<(), Dead> {
        for &(resource, holder) in claims {
            for user in model.resource_users.at(resource) {
                if agree(user.holder, holder) {
                    continue;
                }
                if model.alt_device[model.user_alt(user)] == device {
                    continue;
                }
                if user.is_candidate {
                    self.kill_cand(model, user.id)?;
                } else {
                    self.kill_alt(model, user.id)?;
                }
            }
        }
        Ok(())
    }

    fn follow_cand(&mut self, model: &Model, id: usize) -> Result<(), Dead> {
        let c = model.cand(id);
        let device = model.cand_device(id);
        self.follow_claims(model, device, model.cand_claims.at(id))?;
        for &rule in model.cand_rules.at(id) {
            self.pay_rule(model, rule)?;
        }
        for &other in model.pin_cands.at(c.pin) {
            let o = model.cand(other);
            let clash = if model.cand_device(other) == device {
                o.role != c.role
            } else {
                !agree(o.holder, c.holder) || o.signal != c.signal
            };
            if clash {
                self.kill_cand(model, other)?;
            }
        }
        Ok(())
    }
}
