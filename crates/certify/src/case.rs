//! One case of a proof: what can still be taken, and the weight that tolls show for it.
#![expect(clippy::indexing_slicing, reason = "all indices come from the model")]

use std::collections::BTreeSet;
use std::ops::{Add, Range};

use sensedsl_solve::Objective;
use sensedsl_solve::problem::Problem;

use crate::model::{Model, Thing};

/// What is left of the choices.
#[derive(Clone)]
pub(crate) struct Open {
    /// Device, alternative.
    pub(crate) alternatives: Vec<Vec<bool>>,
    /// Device, alternative, role in the order of the model, candidate.
    pub(crate) candidates: Vec<Vec<Vec<Vec<bool>>>>,
    /// Rules that are violated for sure; their weight is paid.
    pub(crate) violated: BTreeSet<usize>,
}

impl Open {
    pub(crate) fn new(model: &Model) -> Self {
        let devices = model.devices.iter();
        let roles = |uses: &crate::model::Uses| {
            uses.roles.iter().map(|role| vec![true; role.candidates.len()]).collect()
        };
        Self {
            alternatives: devices.clone().map(|device| vec![true; device.len()]).collect(),
            candidates: devices.map(|device| device.iter().map(roles).collect()).collect(),
            violated: BTreeSet::new(),
        }
    }

    /// Takes away what cannot be taken for want of a candidate, then what would be out of order
    /// among alike devices, as the verifier does.
    pub(crate) fn settle(&mut self, model: &Model) {
        for (left, roles) in self.alternatives.iter_mut().zip(&self.candidates) {
            for (left, roles) in left.iter_mut().zip(roles) {
                *left &= roles.iter().all(|role| role.contains(&true));
            }
        }
        for group in &model.alike {
            let mut least = 0;
            for &device in group {
                let (left, places) = (&mut self.alternatives[device], &model.places[device]);
                for (left, place) in left.iter_mut().zip(places) {
                    *left &= *place >= least;
                }
                let places = places.iter().zip(&*left).filter(|(_, left)| **left);
                least = places.map(|(place, _)| *place).min().unwrap_or(least);
            }
            let mut most = usize::MAX;
            for &device in group.iter().rev() {
                let (left, places) = (&mut self.alternatives[device], &model.places[device]);
                for (left, place) in left.iter_mut().zip(places) {
                    *left &= *place <= most;
                }
                let places = places.iter().zip(&*left).filter(|(_, left)| **left);
                most = places.map(|(place, _)| *place).max().unwrap_or(most);
            }
        }
    }

    /// Takes away all that violates a rule.
    pub(crate) fn keep_rule(&mut self, model: &Model, rule: usize) {
        let violates = |uses: &[crate::model::Use]| {
            uses.iter().any(|one| model.things[one.thing] == Thing::Rule(rule))
        };
        for (d, device) in model.devices.iter().enumerate() {
            for (a, uses) in device.iter().enumerate() {
                self.alternatives[d][a] &= !violates(&uses.fixed);
                for (r, role) in uses.roles.iter().enumerate() {
                    for (c, candidate) in role.candidates.iter().enumerate() {
                        self.candidates[d][a][r][c] &= !violates(candidate);
                    }
                }
            }
        }
    }
}

/// One thing to choose at a place.
pub(crate) struct Choice {
    pub(crate) candidate: usize,
    /// Its tolls, in [`Case::tolls`].
    pub(crate) tolls: Range<usize>,
}

/// An alternative that is left.
pub(crate) struct Left {
    pub(crate) alternative: usize,
    /// First what is used anyway, then each role: ranges of [`Case::choices`].
    pub(crate) places: Vec<Range<usize>>,
}

/// A case laid out for speed. A toll is the number of a thing (its price) or, beyond those, of
/// a share.
pub(crate) struct Case {
    pub(crate) devices: Vec<Vec<Left>>,
    pub(crate) choices: Vec<Choice>,
    pub(crate) tolls: Vec<usize>,
    /// For each class of the model the shares of its members that are left.
    pub(crate) members: Vec<Vec<usize>>,
    /// Whether the thing has a single user.
    pub(crate) owned: Vec<bool>,
}

impl Case {
    pub(crate) fn new(model: &Model, open: &Open) -> Self {
        let mut case = Self {
            devices: Vec::new(),
            choices: Vec::new(),
            tolls: Vec::new(),
            members: vec![Vec::new(); model.classes.len()],
            owned: vec![false; model.things.len()],
        };
        for d in 0..model.devices.len() {
            let mut left = Vec::new();
            for a in 0..model.devices[d].len() {
                if open.alternatives[d][a] {
                    left.push(case.alternative(model, open, (d, a)));
                }
            }
            case.devices.push(left);
        }
        for members in &mut case.members {
            members.sort_unstable();
            members.dedup();
        }
        case
    }

    fn alternative(&mut self, model: &Model, open: &Open, (d, a): (usize, usize)) -> Left {
        let uses = &model.devices[d][a];
        let masks = &open.candidates[d][a];
        // The verifier reads the roles in the order of names, and so do we.
        let all = uses.roles.iter().zip(masks);
        let mut before = BTreeSet::new();
        let mut places = Vec::new();
        let fixed = std::slice::from_ref(&uses.fixed);
        let anyway = (fixed, &[true][..]);
        let roles = all.map(|(role, mask)| (role.candidates.as_slice(), mask.as_slice()));
        for (candidates, mask) in std::iter::once(anyway).chain(roles) {
            let first = self.choices.len();
            let mut here = BTreeSet::new();
            for (candidate, uses) in candidates.iter().enumerate().filter(|(c, _)| mask[*c]) {
                let start = self.tolls.len();
                let mut own = BTreeSet::new();
                for one in uses {
                    let thing = model.things[one.thing];
                    let paid = matches!(thing, Thing::Rule(rule) if open.violated.contains(&rule));
                    if !matches!(thing, Thing::Pin(_) | Thing::Moved(_)) {
                        here.insert(one.thing);
                    }
                    if paid || before.contains(&one.thing) || !own.insert(one.thing) {
                        continue;
                    }
                    match (one.share, one.class) {
                        (Some(share), Some(class)) => {
                            self.tolls.push(model.things.len() + share);
                            self.members[class].push(share);
                        }
                        _ => {
                            self.tolls.push(one.thing);
                            self.owned[one.thing] = true;
                        }
                    }
                }
                self.choices.push(Choice { candidate, tolls: start..self.tolls.len() });
            }
            before.extend(here);
            places.push(first..self.choices.len());
        }
        Left { alternative: a, places }
    }

    /// Whether some device has nothing left.
    pub(crate) fn is_empty(&self) -> bool {
        self.devices.iter().any(Vec::is_empty)
    }
}

/// Tolls in some kind of number.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Tolls<N> {
    /// For each thing by how much its price exceeds its weight.
    pub(crate) rents: Vec<N>,
    /// For each share of the model.
    pub(crate) shares: Vec<N>,
    /// For each stream its price.
    pub(crate) streams: Vec<N>,
}

/// What the weights of an objective make of a problem's things.
pub(crate) struct Weighed<'a> {
    pub(crate) problem: &'a Problem,
    pub(crate) model: &'a Model,
    pub(crate) weights: Objective,
    /// For each thing but DMA users.
    pub(crate) of_things: Vec<u64>,
}

impl<'a> Weighed<'a> {
    pub(crate) fn new(problem: &'a Problem, model: &'a Model, weights: Objective) -> Self {
        let things = 0..model.things.len();
        let of_things = things.map(|thing| model.weight(problem, &weights, thing)).collect();
        Self { problem, model, weights, of_things }
    }

    /// The weight of a DMA user: the cheapest stream for each request.
    pub(crate) fn dma_weight<N: Number>(&self, user: usize, streams: &[N]) -> N {
        let requests = self.problem.dma[user].requests.iter();
        requests.fold(N::default(), |sum, request| {
            let prices = request.streams.iter().map(|stream| streams[stream.0 as usize]);
            sum + prices.reduce(N::least).unwrap_or_default()
        })
    }

    /// The weight that the tolls show, exactly; `scale` units of toll are one of weight.
    pub(crate) fn bound(&self, case: &Case, open: &Open, tolls: &Tolls<i64>, scale: i64) -> i64 {
        let weight = |thing: usize| {
            if let Thing::Dma(user) = self.model.things[thing] {
                self.dma_weight(user, &tolls.streams)
            } else {
                self.of_things[thing] as i64 * scale
            }
        };
        let weights: Vec<i64> = (0..self.of_things.len()).map(weight).collect();
        let mut toll: Vec<i64> = weights.iter().zip(&tolls.rents).map(|(w, r)| w + r).collect();
        toll.extend(&tolls.shares);
        let mut bound = open.violated.len() as i64 * i64::from(self.weights.violated) * scale;
        bound -= tolls.streams.iter().sum::<i64>();
        for device in &case.devices {
            let of =
                |choice: &Choice| case.tolls[choice.tolls.clone()].iter().map(|t| toll[*t]).sum();
            let at = |place: &Range<usize>| -> i64 {
                case.choices[place.clone()].iter().map(of).min().unwrap_or(0)
            };
            let all = device.iter().map(|left| left.places.iter().map(at).sum::<i64>());
            bound += all.min().unwrap_or(0);
        }
        let mut excess: Vec<i64> = case
            .owned
            .iter()
            .zip(&tolls.rents)
            .map(|(owned, rent)| if *owned { *rent } else { 0 })
            .collect();
        for (members, thing) in case.members.iter().zip(&self.model.classes) {
            let income: i64 = members.iter().map(|share| tolls.shares[*share]).sum();
            excess[*thing] = excess[*thing].max(income - weights[*thing]);
        }
        bound - excess.iter().sum::<i64>()
    }
}

/// What the two kinds of tolls have in common.
pub(crate) trait Number: Copy + Default + Add<Output = Self> {
    fn least(self, other: Self) -> Self;
}

impl Number for i64 {
    fn least(self, other: Self) -> Self {
        self.min(other)
    }
}

impl Number for f64 {
    fn least(self, other: Self) -> Self {
        self.min(other)
    }
}
