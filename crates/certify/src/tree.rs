//! The case distinction: climb in a case, and where that does not close it, divide it.
#![expect(clippy::indexing_slicing, reason = "all indices come from the model")]

use crate::ascent::{Ascent, Closing, Habits, ascend, first_tolls};
use crate::case::{Case, Open, Tolls, Weighed};
use crate::model::{Model, Thing};
use sensedsl_solve::Cancel;

/// Steps for the whole problem.
const STEPS_FIRST: u32 = 6000;
/// Steps for a case of it.
const STEPS: u32 = 800;
/// Steps for finding out what a division is worth.
const STEPS_PROBE: u32 = 60;
/// Divisions that are tried at a case.
const PROBED: usize = 6;
/// Alternatives of a device that become cases of their own.
const SINGLE_MAX: usize = 12;

/// A node of a proof; children by their place among the nodes.
#[derive(Debug)]
pub(crate) enum Node {
    /// Alternatives by number.
    Device { device: usize, cases: Vec<(Vec<usize>, usize)> },
    /// Role and candidates by number in the problem.
    Role { device: usize, alternative: usize, role: usize, cases: Vec<(Vec<usize>, usize)> },
    /// A soft rule.
    Rule { rule: usize, kept: usize, violated: usize },
    /// Tolls; none where a device has nothing left.
    Leaf(Option<Closing>),
}

/// What ends a search for a proof.
pub(crate) struct Effort<'a> {
    /// Tolls that may still be looked up.
    pub(crate) work: u64,
    pub(crate) cancel: Cancel<'a>,
}

/// No proof was found within the effort.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct GivenUp {
    /// The caller's stop came.
    pub(crate) stopped: bool,
}

struct Prover<'a, 's> {
    weighed: &'a Weighed<'a>,
    classes: Vec<Vec<usize>>,
    limit: i64,
    target: f64,
    nodes: Vec<Node>,
    effort: &'a mut Effort<'s>,
}

/// A tree all of whose leaves weigh more than `limit`; the root is the first node.
pub(crate) fn prove(
    weighed: &Weighed<'_>,
    (limit, target): (i64, f64),
    effort: &mut Effort<'_>,
) -> Result<Vec<Node>, GivenUp> {
    let model = weighed.model;
    let mut classes = vec![Vec::new(); model.things.len()];
    for (class, thing) in model.classes.iter().enumerate() {
        classes[*thing].push(class);
    }
    let start = first_tolls(weighed);
    let mut prover = Prover { weighed, classes, limit, target, nodes: Vec::new(), effort };
    let mut open = Open::new(model);
    open.settle(model);
    prover.node(&open, &start, STEPS_FIRST)?;
    Ok(prover.nodes)
}

/// How to divide a case.
enum Branch {
    Device { device: usize, parts: Vec<Vec<usize>> },
    Role { device: usize, alternative: usize, role: usize, parts: Vec<Vec<usize>> },
    Rule(usize),
}

/// A part of a case after a few steps.
struct Part {
    open: Open,
    /// None where a device has nothing left.
    ascent: Option<Ascent>,
}

impl Part {
    fn closed(&self) -> bool {
        self.ascent.as_ref().is_none_or(|ascent| ascent.closing.is_some())
    }
}

impl Prover<'_, '_> {
    /// Adds the nodes of a case; the place of its first.
    fn node(&mut self, open: &Open, start: &Tolls<f64>, steps: u32) -> Result<usize, GivenUp> {
        let Some(ascent) = self.climb(open, start, steps)? else { return Ok(self.leaf(None)) };
        if ascent.closing.is_some() {
            return Ok(self.leaf(ascent.closing));
        }
        let place = self.leaf(None);
        let (branch, parts) = self.divide(open, &ascent)?;
        let mut children = Vec::new();
        for Part { open, ascent } in parts {
            children.push(match ascent {
                Some(Ascent { closing: None, tolls, .. }) => self.node(&open, &tolls, STEPS)?,
                Some(Ascent { closing, .. }) => self.leaf(closing),
                None => self.leaf(None),
            });
        }
        self.nodes[place] = match branch {
            Branch::Device { device, parts } => {
                Node::Device { device, cases: parts.into_iter().zip(children).collect() }
            }
            Branch::Role { device, alternative, role, parts } => {
                let role = self.weighed.model.devices[device][alternative].roles[role].index;
                let cases = parts.into_iter().zip(children).collect();
                Node::Role { device, alternative, role, cases }
            }
            Branch::Rule(rule) => Node::Rule { rule, kept: children[0], violated: children[1] },
        };
        Ok(place)
    }

    fn leaf(&mut self, closing: Option<Closing>) -> usize {
        self.nodes.push(Node::Leaf(closing));
        self.nodes.len() - 1
    }

    /// Climbs in a case; none where a device has nothing left.
    fn climb(
        &mut self,
        open: &Open,
        start: &Tolls<f64>,
        steps: u32,
    ) -> Result<Option<Ascent>, GivenUp> {
        let case = Case::new(self.weighed.model, open);
        if case.is_empty() {
            return Ok(None);
        }
        let goal = (self.limit, self.target, steps);
        let ascent = ascend(self.weighed, &case, open, start, &self.classes, goal, self.effort);
        self.effort.work = self.effort.work.saturating_sub(ascent.work);
        let stopped = self.effort.cancel.is_over();
        if self.effort.work == 0 || stopped {
            return Err(GivenUp { stopped });
        }
        Ok(Some(ascent))
    }

    /// Of the most undecided choices the one that leaves least to be shown.
    fn divide(&mut self, open: &Open, above: &Ascent) -> Result<(Branch, Vec<Part>), GivenUp> {
        let model = self.weighed.model;
        let case = Case::new(model, open);
        let mut branches = branches(model, &case, open, &above.habits);
        if self.weighed.weights.violated == 0 {
            branches.retain(|(_, branch)| !matches!(branch, Branch::Rule(_)));
        }
        branches.sort_by(|a, b| b.0.total_cmp(&a.0));
        let mut best: Option<(f64, Branch, Vec<Part>)> = None;
        for (_, branch) in branches.into_iter().take(PROBED) {
            let mut parts = Vec::new();
            let mut left = 0.0;
            for open in self.parts(open, &branch) {
                let ascent = self.climb(&open, &above.tolls, STEPS_PROBE)?;
                let part = Part { open, ascent };
                if !part.closed() {
                    let bound = part.ascent.as_ref().map_or(0.0, |ascent| ascent.bound);
                    let gap = (self.target - above.bound).max(1e-9);
                    // What is left of the gap, its halves counting far less than the half.
                    let open = (1.0 - (bound - above.bound) / gap).clamp(0.0, 1.0);
                    left += open * open * open + 0.02;
                }
                parts.push(part);
            }
            if best.as_ref().is_none_or(|(least, ..)| left < *least) {
                let open = parts.iter().filter(|part| !part.closed()).count();
                best = Some((left, branch, parts));
                if open <= 1 {
                    break;
                }
            }
        }
        best.map(|(_, branch, parts)| (branch, parts)).ok_or(GivenUp { stopped: false })
    }

    fn parts(&self, open: &Open, branch: &Branch) -> Vec<Open> {
        let mut parts = self.divided(open, branch);
        parts.iter_mut().for_each(|part| part.settle(self.weighed.model));
        parts
    }

    fn divided(&self, open: &Open, branch: &Branch) -> Vec<Open> {
        let keep = |mask: &mut [bool], keep: &[usize]| {
            for (at, left) in mask.iter_mut().enumerate() {
                *left &= keep.contains(&at);
            }
        };
        match branch {
            Branch::Device { device, parts } => {
                let part = |one: &Vec<usize>| {
                    let mut part = open.clone();
                    keep(&mut part.alternatives[*device], one);
                    part
                };
                parts.iter().map(part).collect()
            }
            Branch::Role { device, alternative, role, parts } => {
                let part = |one: &Vec<usize>| {
                    let mut part = open.clone();
                    keep(&mut part.candidates[*device][*alternative][*role], one);
                    part
                };
                parts.iter().map(part).collect()
            }
            Branch::Rule(rule) => {
                let (mut kept, mut violated) = (open.clone(), open.clone());
                kept.keep_rule(self.weighed.model, *rule);
                violated.violated.insert(*rule);
                vec![kept, violated]
            }
        }
    }
}

/// All divisions, each with how undecided it is.
fn branches(model: &Model, case: &Case, open: &Open, habits: &Habits) -> Vec<(f64, Branch)> {
    let mut all = Vec::new();
    for (device, left) in case.devices.iter().enumerate() {
        if let [only] = left.as_slice() {
            let alternative = only.alternative;
            let roles = only.places.iter().skip(1).enumerate();
            for (role, place) in roles.filter(|(_, place)| place.len() > 1) {
                let choices = &case.choices[place.clone()];
                let shares = choices.iter().zip(&habits.choices[place.clone()]);
                let shares: Vec<_> = shares.map(|(one, often)| (one.candidate, *often)).collect();
                let parts = halves(&shares).into();
                let branch = Branch::Role { device, alternative, role, parts };
                all.push((spread(&shares, habits.total), branch));
            }
        } else {
            let shares = left.iter().zip(&habits.alternatives[device]);
            let shares: Vec<_> = shares.map(|(one, often)| (one.alternative, *often)).collect();
            let parts = if shares.len() > SINGLE_MAX {
                halves(&shares).into()
            } else {
                shares.iter().map(|(one, _)| vec![*one]).collect()
            };
            all.push((1.0 + spread(&shares, habits.total), Branch::Device { device, parts }));
        }
    }
    for (thing, often) in model.things.iter().zip(&habits.things) {
        if let Thing::Rule(rule) = *thing
            && !open.violated.contains(&rule)
            && *often > 0.0
        {
            let often = (often / habits.total).min(1.0);
            all.push((1.0 + 2.0 * often.min(1.0 - often), Branch::Rule(rule)));
        }
    }
    all
}

/// How far the most frequent choice is from being the only one.
fn spread(shares: &[(usize, f64)], total: f64) -> f64 {
    let most = shares.iter().map(|(_, often)| *often).fold(0.0, f64::max);
    1.0 - most / total.max(1e-300)
}

/// Two parts that were chosen about equally often.
fn halves(shares: &[(usize, f64)]) -> [Vec<usize>; 2] {
    let mut order = shares.to_vec();
    order.sort_by(|a, b| b.1.total_cmp(&a.1));
    let mut parts = [Vec::new(), Vec::new()];
    let mut sums = [0.0, 0.0];
    for (choice, often) in order {
        let lighter = usize::from(sums[1] < sums[0]);
        parts[lighter].push(choice);
        // A choice that was never made still goes to the shorter part in turn.
        sums[lighter] += often + 1e-9;
    }
    for part in &mut parts {
        part.sort_unstable();
    }
    parts
}
