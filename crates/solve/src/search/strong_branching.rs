//! What the linear program suggests: its values in, a wiring to try or a branch out.
//!
//! Of what the program leaves in parts, that is asked first which, tried both ways, raises the bound
//! most; what earlier tries have shown is remembered.
#![expect(clippy::indexing_slicing, reason = "all ids come from the model")]

use crate::domains::{Charge, Dead};
use crate::search::Engine;
use crate::search::branching::Branch;

/// Values nearer to a whole number count as whole.
const WHOLE: f64 = 0.01;

/// Questions that are tried at one node before one is asked.
const PROBES: usize = 8;

/// A question that was tried so often is known.
const RELIABLE: u32 = 4;

/// Steps of the simplex method for each try.
const PROBE_STEPS: usize = 100;

/// A gain that is as good as none.
const LITTLE: f64 = 1e-3;

impl Engine<'_> {
    /// Gives each device the alternative that the linear program gives it as a whole, and reads
    /// the wiring that the flow then has.
    pub(crate) fn round(&mut self) {
        let model = self.model;
        let mark = self.domains.mark();
        let saved = self.flow.save();
        if self.decide_whole().is_ok()
            && self.settle().is_ok()
            && self.bound() < self.limit
            && let Ok(choices) = self.read()
        {
            let weight = model.evaluate(&choices);
            if weight < self.limit && self.floor.is_none_or(|floor| weight > floor) {
                self.limit = weight;
                self.best = Some((weight, choices));
            }
        }
        self.back(mark, &saved);
    }

    /// As many of the devices that are alike go to an alternative as it is worth in whole numbers.
    fn decide_whole(&mut self) -> Result<(), Dead> {
        let model = self.model;
        let Some(prices) = &self.prices else { return Err(Dead) };
        for class in (0..model.devices).filter(|&d| model.class[d] == d) {
            let devices: Vec<usize> =
                (class..model.devices).filter(|&d| model.class[d] == class).collect();
            let first = model.alts.range(class).start;
            for alt in model.alts.range(class) {
                let of = |d: usize| model.alts.range(d).start + alt - first;
                let has = |d: &&usize| self.domains.decided(**d) == Some(of(**d));
                let have = devices.iter().filter(has).count();
                let whole = (prices.relaxation.value(model, alt) + WHOLE) as usize;
                let open: Vec<usize> = devices
                    .iter()
                    .map(|&d| of(d))
                    .filter(|&a| {
                        self.domains.alt_on(a)
                            && self.domains.decided(model.alt_device[a]).is_none()
                    })
                    .take(whole.saturating_sub(have))
                    .collect();
                for alt in open {
                    self.domains.decide(model, alt)?;
                }
            }
        }
        Ok(())
    }

    /// What to branch on by the values of the linear program, `fallback` where they do not tell;
    /// nothing when one side of a branch is dead and the other one is taken.
    pub(crate) fn guided(&mut self, fallback: Branch) -> Result<Option<Branch>, Dead> {
        if let Some(board) = self.deciding_board() {
            return Ok(Some(board));
        }
        let alt = match fallback {
            Branch::Alt(alt) => Some(alt),
            // Which pin of one device is asked last: what the program leaves open says more.
            Branch::Cand(_) => None,
            Branch::Rule(_) | Branch::Board(_) | Branch::Facility(_) => return Ok(Some(fallback)),
        };
        let open = self.open_questions();
        if open.is_empty() {
            let Some(alt) = alt else { return Ok(Some(fallback)) };
            let alts = self.domains.alts(self.model, self.model.alt_device[alt]);
            let likeliest = self.likeliest(alts).map(Branch::Alt);
            return Ok(Some(likeliest.unwrap_or(fallback)));
        }
        self.strongest(&open)
    }

    /// The question whose answers, both of them, raise the bound most. Little is known of new
    /// questions, so both sides of those are bounded here.
    fn strongest(&mut self, open: &[Question]) -> Result<Option<Branch>, Dead> {
        let now = self.prices.as_ref().map_or(0.0, |prices| prices.relaxation.worth());
        let mut best = (f64::NEG_INFINITY, None);
        let mut probes = 0;
        for question in open {
            let Some(prices) = &self.prices else { break };
            let mut gains = prices.history.expected(question);
            if !prices.history.is_known(question) && probes < PROBES && !self.cancel.is_over() {
                probes += 1;
                let sides = [true, false].map(|side| self.probe(question.branch, side));
                gains = match sides {
                    [Err(Dead), Err(Dead)] => return Err(Dead),
                    [Err(Dead), Ok(_)] => return self.refuse(question.branch).map(|()| None),
                    [Ok(_), Err(Dead)] => return self.take(question.branch).map(|()| None),
                    [Ok(taken), Ok(refused)] => [taken - now, refused - now].map(|g| g.max(0.0)),
                };
                if let Some(prices) = &mut self.prices {
                    prices.history.note(question, gains);
                }
            }
            let score = gains[0].max(LITTLE) * gains[1].max(LITTLE);
            if score > best.0 {
                best = (score, Some(question.branch));
            }
        }
        Ok(best.1)
    }

    /// The bound on one side of a branch.
    fn probe(&mut self, branch: Branch, side: bool) -> Result<f64, Dead> {
        let mark = self.domains.mark();
        let saved = self.flow.save();
        let went = if side { self.take(branch) } else { self.refuse(branch) };
        let bound = went.and_then(|()| self.settle()).and_then(|()| {
            if self.bound() >= self.limit { Err(Dead) } else { self.bound_by_prices(PROBE_STEPS) }
        });
        self.back(mark, &saved);
        bound
    }

    /// The alternative with the greatest value.
    fn likeliest(&self, alts: impl Iterator<Item = usize>) -> Option<usize> {
        let prices = self.prices.as_ref()?;
        let valued = alts.map(|alt| (prices.relaxation.value(self.model, alt), alt));
        valued.max_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1))).map(|(_, alt)| alt)
    }

    /// What the linear program leaves in parts, the most even first.
    fn open_questions(&self) -> Vec<Question> {
        let (model, mut open) = (self.model, Vec::new());
        let Some(prices) = &self.prices else { return open };
        let mut add = |branch, key, value: f64| {
            let part = value - (value + WHOLE).floor();
            if part > WHOLE {
                open.push(Question { branch, key, part });
            }
        };
        let facilities = prices.terms.facilities.len();
        for (index, facility) in prices.terms.facilities.iter().enumerate() {
            // Only what changes the domains, whichever way it is answered.
            let usable = facility.alts.iter().any(|&alt| self.domains.alt_on(alt));
            if usable && !self.domains.opened.contains(&index) {
                add(Branch::Facility(index), index, prices.relaxation.opened(index));
            }
        }
        let after = facilities + model.alt_device.len();
        for (index, penalty) in prices.terms.penalties.iter().enumerate() {
            if self.domains.rule[penalty.rule] == Charge::Open {
                // Taken is the side without it.
                add(
                    Branch::Rule(penalty.rule),
                    after + index,
                    1.0 - prices.relaxation.violated(index),
                );
            }
        }
        let mut seen = vec![false; model.alt_device.len()];
        for device in (0..model.devices).filter(|&d| self.domains.device_left(d) > 1) {
            for alt in self.domains.alts(model, device) {
                let offset = alt - model.alts.range(device).start;
                let of_class = model.alts.range(model.class[device]).start + offset;
                if !std::mem::replace(&mut seen[of_class], true) {
                    let value = prices.relaxation.value(model, alt);
                    add(Branch::Alt(alt), facilities + of_class, value);
                }
            }
        }
        let even = |q: &Question| (q.part - 0.5).abs();
        open.sort_by(|a, b| even(a).total_cmp(&even(b)).then(a.key.cmp(&b.key)));
        open
    }
}

/// Something that the linear program leaves in parts.
#[derive(Clone, Copy, Debug)]
struct Question {
    branch: Branch,
    /// Its place in the history.
    key: usize,
    /// How much of it there is beyond a whole number.
    part: f64,
}

/// How much earlier answers to a question have raised the bound, for each whole that was missing.
#[derive(Clone, Debug, Default)]
pub(crate) struct PseudoCosts {
    known: Vec<[(f64, u32); 2]>,
}

impl PseudoCosts {
    fn missing(question: &Question) -> [f64; 2] {
        [1.0 - question.part, question.part]
    }

    fn note(&mut self, question: &Question, gains: [f64; 2]) {
        if self.known.len() <= question.key {
            self.known.resize(question.key + 1, [(0.0, 0); 2]);
        }
        let sides = self.known[question.key].iter_mut().zip(gains).zip(Self::missing(question));
        for (((sum, number), gain), missing) in sides {
            *sum += gain / missing;
            *number += 1;
        }
    }

    fn is_known(&self, question: &Question) -> bool {
        self.known.get(question.key).is_some_and(|sides| sides[0].1 >= RELIABLE)
    }

    fn expected(&self, question: &Question) -> [f64; 2] {
        let Some(sides) = self.known.get(question.key) else { return [0.0; 2] };
        let [taken, refused] = sides.map(|(sum, number)| sum / f64::from(number.max(1)));
        let [to_one, to_none] = Self::missing(question);
        [taken * to_one, refused * to_none]
    }
}
