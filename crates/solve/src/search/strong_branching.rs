//! Strong branching: the values of the linear program in, a branch out.
//!
//! Of the fractional variables, a node branches on the one whose two children have the best bounds.
//! To find these bounds it tries both children (D. Applegate, R. Bixby, V. Chvátal and W. Cook,
//! *Finding cuts in the TSP*, 1995), unless earlier trials have shown them
//! ([`super::pseudo_costs`]).

use super::Engine;
use super::branch::Branch;
use super::pseudo_costs::{Fractional, Key};
use super::rounding::WHOLE;
use crate::domains::{Charge, Pruned};
use crate::index::{AltId, IdVec};

/// The most variables that are tried at one node.
const TRIALS: usize = 8;

/// Steps of the simplex method for each trial.
const TRIAL_STEPS: usize = 100;

/// Smaller gains count as this much.
const LITTLE: f64 = 1e-3;

impl Engine<'_> {
    /// What to branch on according to the values of the linear program, or `fallback` if they do
    /// not tell. Nothing if one side of a branch was pruned and the other one was taken.
    pub(super) fn choose_branch(&mut self, fallback: Branch) -> Result<Option<Branch>, Pruned> {
        if let Some(board) = self.deciding_board() {
            return Ok(Some(board));
        }
        let alt = match fallback {
            Branch::Alt(alt) => Some(alt),
            // The pin of a single device comes last: what the program leaves open says more.
            Branch::Cand(_) => None,
            Branch::Rule(_) | Branch::Board(_) | Branch::Facility(_) => return Ok(Some(fallback)),
        };
        let open = self.fractional();
        if open.is_empty() {
            let Some(alt) = alt else { return Ok(Some(fallback)) };
            let alts = self.domains.alts(self.model, self.model.alt_device[alt]);
            let likeliest = self.likeliest(alts).map(Branch::Alt);
            return Ok(Some(likeliest.unwrap_or(fallback)));
        }
        self.strongest(&open)
    }

    /// The fractional variable with the greatest product of gains. A new variable has no reliable
    /// pseudo-costs yet, so both of its children are bounded here.
    fn strongest(&mut self, open: &[Fractional]) -> Result<Option<Branch>, Pruned> {
        let now = self.pricing.as_ref().map_or(0.0, |pricing| pricing.relaxation.bound());
        let mut best = (f64::NEG_INFINITY, None);
        let mut trials = 0;
        for question in open {
            let Some(pricing) = &self.pricing else { break };
            let mut gains = pricing.pseudo_costs.expected(question);
            if let Some(sides) = self.try_both(question, &mut trials) {
                gains = match sides {
                    [Err(Pruned), Err(Pruned)] => return Err(Pruned),
                    [Err(Pruned), Ok(_)] => return self.refuse(question.branch).map(|()| None),
                    [Ok(_), Err(Pruned)] => return self.take(question.branch).map(|()| None),
                    [Ok(taken), Ok(refused)] => [taken - now, refused - now].map(|g| g.max(0.0)),
                };
                if let Some(pricing) = &mut self.pricing {
                    pricing.pseudo_costs.note(question, gains);
                }
            }
            let [taken, refused] = gains.map(|gain| gain.max(LITTLE));
            let score = taken * refused;
            if score > best.0 {
                best = (score, Some(question.branch));
            }
        }
        Ok(best.1)
    }

    /// Like [`Self::strongest`], but for a record: a variable with a pruned side is the branch.
    /// `None` if nothing is fractional.
    pub(super) fn strongest_recorded(&mut self) -> Option<Branch> {
        let now = self.pricing.as_ref().map_or(0.0, |pricing| pricing.relaxation.bound());
        let mut best = (f64::NEG_INFINITY, None);
        let mut trials = 0;
        for question in self.fractional() {
            let Some(pricing) = &self.pricing else { break };
            let mut gains = pricing.pseudo_costs.expected(&question);
            if let Some(sides) = self.try_both(&question, &mut trials) {
                let [Ok(taken), Ok(refused)] = sides else { return Some(question.branch) };
                gains = [taken - now, refused - now].map(|gain| gain.max(0.0));
                if let Some(pricing) = &mut self.pricing {
                    pricing.pseudo_costs.note(&question, gains);
                }
            }
            let [taken, refused] = gains.map(|gain| gain.max(LITTLE));
            if taken * refused > best.0 {
                best = (taken * refused, Some(question.branch));
            }
        }
        best.1
    }

    /// The bounds on both sides of a branch. Nothing if earlier trials have shown them, or if there
    /// were enough trials.
    fn try_both(
        &mut self,
        question: &Fractional,
        trials: &mut usize,
    ) -> Option<[Result<f64, Pruned>; 2]> {
        let pricing = self.pricing.as_mut()?;
        let is_known = pricing.pseudo_costs.is_known(question);
        if is_known || *trials >= TRIALS || self.cancel.is_over() {
            return None;
        }
        if *trials == 0 {
            // Each trial starts from the present basis.
            pricing.relaxation.remember();
        }
        *trials += 1;
        Some([true, false].map(|side| self.try_side(question.branch, side)))
    }

    /// The bound on one side of a branch, by prices alone: the flow would add little to them.
    fn try_side(&mut self, branch: Branch, taken: bool) -> Result<f64, Pruned> {
        let mark = self.domains.mark();
        let went = if taken { self.take(branch) } else { self.refuse(branch) };
        let bound = went
            .and_then(|()| self.domains.propagate(self.model))
            .and_then(|()| self.bound_by_prices(TRIAL_STEPS));
        self.domains.undo(self.model, mark);
        if let Some(pricing) = &mut self.pricing {
            pricing.relaxation.go_back();
        }
        bound
    }

    /// The alternative with the greatest value.
    fn likeliest(&self, alts: impl Iterator<Item = AltId>) -> Option<AltId> {
        let pricing = self.pricing.as_ref()?;
        let valued = alts.map(|alt| (pricing.relaxation.value(self.model, alt), alt));
        valued.max_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1))).map(|(_, alt)| alt)
    }

    /// The variables that the linear program leaves fractional, those nearest to one half first.
    fn fractional(&self) -> Vec<Fractional> {
        let (model, mut open) = (self.model, Vec::new());
        let Some(pricing) = &self.pricing else { return open };
        let mut add = |branch, key, value: f64| {
            let part = value - (value + WHOLE).floor();
            if part > WHOLE {
                open.push(Fractional { branch, key, part });
            }
        };
        for (index, facility) in pricing.dualized.facilities.enumerate() {
            // Only facilities that change the domains, whichever way the question is answered.
            let usable = facility.alts.iter().any(|&alt| self.domains.has_alt(alt));
            if usable && !self.domains.opened.contains(&index) {
                let value = pricing.relaxation.opened(index);
                add(Branch::Facility(index), Key::Facility(index), value);
            }
        }
        for (index, penalty) in pricing.dualized.penalties.enumerate() {
            if self.domains.rule[penalty.rule] == Charge::Open {
                // The side taken is the one without the violation.
                let value = 1.0 - pricing.relaxation.violated(index);
                add(Branch::Rule(penalty.rule), Key::Penalty(index), value);
            }
        }
        let mut seen = IdVec::same(false, model.alt_device.len());
        for device in model.devices.iter().filter(|&d| self.domains.alts_left(d) > 1) {
            for alt in self.domains.alts(model, device) {
                let of_group = model.twin_alt(alt, pricing.relaxation.group(device));
                if !std::mem::replace(&mut seen[of_group], true) {
                    let value = pricing.relaxation.value(model, alt);
                    add(Branch::Alt(alt), Key::Alt(of_group), value);
                }
            }
        }
        let even = |q: &Fractional| (q.part - 0.5).abs();
        open.sort_by(|a, b| even(a).total_cmp(&even(b)).then(a.key.cmp(&b.key)));
        open
    }
}
