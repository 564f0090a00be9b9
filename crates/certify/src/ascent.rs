//! Tolls that show much weight: a subgradient ascent with the known optimum as its target.
//!
//! Each device takes what is cheapest for it at the present tolls. Where more of them than can
//! take the same thing the toll rises, where nobody does it falls; the step is Polyak's, towards
//! the weight to be shown. The tolls that are kept are whole numbers and their bound is computed
//! exactly, so floating point decides only how fast a proof is found, never whether it is one.
#![expect(clippy::indexing_slicing, reason = "all indices come from the model")]

use crate::case::{Case, Open, Tolls, Weighed};
use crate::model::Thing;
use crate::tree::Effort;

/// Units of toll in a unit of weight that are tried; the smaller, the easier to read.
const SCALES: [i64; 7] = [1, 2, 4, 12, 60, 840, 10_080];
/// Steps without a better bound before the step becomes shorter.
const PATIENCE: u32 = 50;
/// The shortest step, as a part of Polyak's.
const STEP_MIN: f64 = 0.001;
/// Growth from step to step of what the choices of a step count for the choice of a branch.
const RECENT: f64 = 1.03;
/// What it takes to bring a share back to its price, in tolls looked up.
const PROJECTION: usize = 8;
/// Of choices that cost nearly the same the device takes the one that is used least.
const TIE: f64 = 1e-7;

/// Whole tolls that close a case.
#[derive(Clone, Debug)]
pub(crate) struct Closing {
    pub(crate) scale: i64,
    pub(crate) tolls: Tolls<i64>,
    /// The shares that somebody who is left could pay.
    pub(crate) used: Vec<usize>,
}

/// How often things were chosen, for finding out what to branch on.
pub(crate) struct Habits {
    /// For each device, for each of [`Case::devices`]' alternatives.
    pub(crate) alternatives: Vec<Vec<f64>>,
    /// For each of [`Case::choices`].
    pub(crate) choices: Vec<f64>,
    /// For each thing.
    pub(crate) things: Vec<f64>,
    /// All steps together.
    pub(crate) total: f64,
}

/// What an ascent came to.
pub(crate) struct Ascent {
    pub(crate) closing: Option<Closing>,
    /// The best tolls, for the cases of this case to begin with.
    pub(crate) tolls: Tolls<f64>,
    /// The weight they show.
    pub(crate) bound: f64,
    pub(crate) habits: Habits,
    /// Tolls looked up, a measure of the work.
    pub(crate) work: u64,
}

struct Climber<'a> {
    weighed: &'a Weighed<'a>,
    case: &'a Case,
    open: &'a Open,
    /// Classes of each thing.
    classes: &'a [Vec<usize>],
    tolls: Tolls<f64>,
    /// Price of each thing, then the shares.
    toll: Vec<f64>,
    /// How many use each thing as their own, then for each share whether it is paid.
    used: Vec<f64>,
    habits: Habits,
    recent: f64,
}

/// Tolls to begin with: of those who use a thing together the first pays all.
pub(crate) fn first_tolls(weighed: &Weighed<'_>) -> Tolls<f64> {
    let model = weighed.model;
    let mut shares = vec![0.0; model.shares.len()];
    let mut seen = vec![false; model.things.len()];
    for (share, (thing, _)) in shares.iter_mut().zip(&model.shares) {
        if !std::mem::replace(&mut seen[*thing], true) {
            *share = weighed.of_things[*thing] as f64;
        }
    }
    let rents = vec![0.0; model.things.len()];
    Tolls { rents, shares, streams: vec![0.0; weighed.problem.streams as usize] }
}

/// Climbs until the case is closed (more weight than `limit` is shown), nothing moves any more, `steps`
/// are done or the effort is spent.
pub(crate) fn ascend(
    weighed: &Weighed<'_>,
    case: &Case,
    open: &Open,
    start: &Tolls<f64>,
    classes: &[Vec<usize>],
    (limit, target, steps): (i64, f64, u32),
    effort: &Effort<'_>,
) -> Ascent {
    let mut climber = Climber::new(weighed, case, open, start, classes);
    let mut best = (f64::MIN, start.clone());
    let mut tried = f64::NEG_INFINITY;
    let mut closing = None;
    let mut direction = Tolls::default();
    let (mut part, mut waited, mut work) = (1.0, 0, 0);
    // Every toll is looked up, and those of each share several times more to bring it back to its price.
    let step_work = (case.tolls.len() + PROJECTION * weighed.model.shares.len()) as u64 + 1;
    for step in 0..steps {
        if work > effort.work || (step % 16 == 0 && effort.cancel.is_over()) {
            break;
        }
        let bound = climber.choose();
        work += step_work;
        if bound > best.0 + 1e-9 * best.0.abs() {
            if bound - best.0 > (target - best.0) * 0.01 {
                waited = 0;
            }
            best = (bound, climber.tolls.clone());
        }
        waited += 1;
        if bound > limit as f64 && bound > tried {
            // Each further trial asks for a bit more, so few are in vain.
            tried = bound + (target - bound).max(0.0) * 0.05;
            work += case.tolls.len() as u64 * SCALES.len() as u64;
            closing = climber.whole(limit);
            if closing.is_some() {
                break;
            }
        }
        if waited > PATIENCE {
            part *= 0.6;
            waited = 0;
            if part < STEP_MIN {
                break;
            }
            climber.tolls = best.1.clone();
            direction = Tolls::default();
            continue;
        }
        if !climber.step(&mut direction, part * (target - bound).max(0.1)) {
            break;
        }
    }
    let habits = climber.habits;
    Ascent { closing, tolls: best.1, bound: best.0, habits, work }
}

impl<'a> Climber<'a> {
    fn new(
        weighed: &'a Weighed<'a>,
        case: &'a Case,
        open: &'a Open,
        start: &Tolls<f64>,
        classes: &'a [Vec<usize>],
    ) -> Self {
        let model = weighed.model;
        let mut tolls = start.clone();
        let mut left = vec![false; model.shares.len()];
        for share in case.members.iter().flatten() {
            left[*share] = true;
        }
        for (share, left) in tolls.shares.iter_mut().zip(left) {
            if !left {
                *share = 0.0;
            }
        }
        let habits = Habits {
            alternatives: case.devices.iter().map(|device| vec![0.0; device.len()]).collect(),
            choices: vec![0.0; case.choices.len()],
            things: vec![0.0; model.things.len()],
            total: 0.0,
        };
        let all = model.things.len() + model.shares.len();
        let (toll, used) = (vec![0.0; all], vec![0.0; all]);
        Self { weighed, case, open, classes, tolls, toll, used, habits, recent: 1.0 }
    }

    /// Lets each device take what is cheapest; the weight shown.
    fn choose(&mut self) -> f64 {
        let Weighed { model, weights, of_things, .. } = self.weighed;
        let things = model.things.len();
        let prices = of_things.iter().zip(&self.tolls.rents).map(|(w, rent)| *w as f64 + rent);
        for (toll, price) in self.toll.iter_mut().zip(prices) {
            *toll = price;
        }
        self.toll[things..].copy_from_slice(&self.tolls.shares);
        self.used.fill(0.0);
        self.recent *= RECENT;
        self.habits.total += self.recent;
        let mut bound = self.open.violated.len() as f64 * f64::from(weights.violated);
        bound -= self.tolls.streams.iter().sum::<f64>();
        let mut chosen = Vec::new();
        for d in 0..self.case.devices.len() {
            bound += self.choose_for(d, &mut chosen);
        }
        bound - self.excesses().iter().sum::<f64>()
    }

    /// Books what is cheapest for one device; its tolls.
    fn choose_for(&mut self, d: usize, chosen: &mut Vec<usize>) -> f64 {
        let case = self.case;
        let mut best = (f64::INFINITY, f64::INFINITY, 0);
        chosen.clear();
        let mut here = Vec::new();
        for (at, left) in case.devices[d].iter().enumerate() {
            here.clear();
            let (mut sum, mut sum_with_ties) = (0.0, 0.0);
            for place in &left.places {
                let mut least = (f64::INFINITY, f64::INFINITY, 0);
                for number in place.clone() {
                    let (mut toll, mut taken) = (0.0, 0.0);
                    for slot in &case.tolls[case.choices[number].tolls.clone()] {
                        toll += self.toll[*slot];
                        taken += self.used[*slot];
                    }
                    let with_ties = toll + taken * TIE * (1.0 + toll);
                    if with_ties < least.0 {
                        least = (with_ties, toll, number);
                    }
                }
                sum_with_ties += least.0;
                sum += least.1;
                here.push(least.2);
            }
            if sum_with_ties < best.0 {
                best = (sum_with_ties, sum, at);
                std::mem::swap(chosen, &mut here);
            }
        }
        let things = self.weighed.model.things.len();
        self.habits.alternatives[d][best.2] += self.recent;
        for number in chosen.iter() {
            self.habits.choices[*number] += self.recent;
            for slot in &case.tolls[case.choices[*number].tolls.clone()] {
                self.used[*slot] += 1.0;
                let thing = slot.checked_sub(things);
                let thing = thing.map_or(*slot, |share| self.weighed.model.shares[share].0);
                self.habits.things[thing] += self.recent;
            }
        }
        best.1
    }

    /// By how much each thing takes in more than it weighs.
    fn excesses(&self) -> Vec<f64> {
        let Weighed { model, of_things, .. } = self.weighed;
        let rents = self.case.owned.iter().zip(&self.tolls.rents);
        let mut excesses: Vec<f64> =
            rents.map(|(owned, rent)| if *owned { *rent } else { 0.0 }).collect();
        for (members, thing) in self.case.members.iter().zip(&model.classes) {
            let weight = if let Thing::Dma(user) = model.things[*thing] {
                self.weighed.dma_weight(user, &self.tolls.streams)
            } else {
                of_things[*thing] as f64
            };
            let income: f64 = members.iter().map(|share| self.tolls.shares[*share]).sum();
            excesses[*thing] = excesses[*thing].max(income - weight);
        }
        excesses
    }

    /// The subgradient at the present choices.
    fn gradient(&self) -> Tolls<f64> {
        let model = self.weighed.model;
        let things = model.things.len();
        let mut rents: Vec<f64> = self.used[..things].iter().map(|used| used - 1.0).collect();
        let mut shares = self.used[things..].to_vec();
        let mut streams = vec![-1.0; self.tolls.streams.len()];
        let excesses = self.excesses();
        for (class, thing) in model.classes.iter().enumerate() {
            let Thing::Dma(user) = model.things[*thing] else { continue };
            if excesses[*thing] <= 1e-12 {
                continue;
            }
            for share in &self.case.members[class] {
                shares[*share] -= 1.0;
            }
            for request in &self.weighed.problem.dma[user].requests {
                let price = |stream: &usize| self.tolls.streams[*stream];
                let all = request.streams.iter().map(|stream| stream.0 as usize);
                let cheapest = all.min_by(|a, b| price(a).total_cmp(&price(b)));
                if let Some(stream) = cheapest {
                    streams[stream] += 1.0;
                }
            }
        }
        for (thing, rent) in rents.iter_mut().enumerate() {
            let bound_to_weight = matches!(
                model.things[thing],
                Thing::Moved(_) | Thing::Rule(_) | Thing::Spare(_) | Thing::Dma(_)
            );
            if bound_to_weight || (self.tolls.rents[thing] <= 0.0 && *rent < 0.0) {
                *rent = 0.0;
            }
        }
        for (stream, gradient) in streams.iter_mut().enumerate() {
            if self.tolls.streams[stream] <= 0.0 && *gradient < 0.0 {
                *gradient = 0.0;
            }
        }
        Tolls { rents, shares, streams }
    }

    /// One step; false where there is nowhere to go.
    fn step(&mut self, direction: &mut Tolls<f64>, gap: f64) -> bool {
        let gradient = self.gradient();
        // A step that would go back and forth is bent towards the one before (Camerini,
        // Fratta and Maffioli).
        let back = dot(&gradient, direction);
        let bend = if back < 0.0 { -1.5 * back / dot(direction, direction) } else { 0.0 };
        let bent = |new: &[f64], old: &[f64]| -> Vec<f64> {
            let old = old.iter().copied().chain(std::iter::repeat(0.0));
            new.iter().zip(old).map(|(new, old)| new + bend * old).collect()
        };
        *direction = Tolls {
            rents: bent(&gradient.rents, &direction.rents),
            shares: bent(&gradient.shares, &direction.shares),
            streams: bent(&gradient.streams, &direction.streams),
        };
        let norm = dot(direction, direction);
        if norm < 1e-9 {
            return false;
        }
        let length = gap / norm;
        let go = |at: &mut Vec<f64>, along: &[f64]| {
            for (at, along) in at.iter_mut().zip(along) {
                *at = (*at + length * along).max(0.0);
            }
        };
        let Tolls { rents, shares, streams } = &mut self.tolls;
        for (at, along) in rents.iter_mut().zip(&direction.rents) {
            *at += length * along;
        }
        go(shares, &direction.shares);
        go(streams, &direction.streams);
        self.project();
        true
    }

    /// Back to tolls where no class pays more than its thing's price.
    fn project(&mut self) {
        let Weighed { model, of_things, .. } = self.weighed;
        for (thing, classes) in self.classes.iter().enumerate() {
            let rent = self.tolls.rents[thing];
            let weight = of_things[thing] as f64;
            let fixed = match model.things[thing] {
                Thing::Dma(_) => continue,
                Thing::Moved(_) | Thing::Rule(_) | Thing::Spare(_) => true,
                Thing::Pin(_) | Thing::Resource(_) => false,
            };
            let lists: Vec<&[usize]> = classes
                .iter()
                .map(|class| self.case.members[*class].as_slice())
                .filter(|members| !members.is_empty())
                .collect();
            let shares = &self.tolls.shares;
            let rent = if fixed {
                0.0
            } else if lists.is_empty() {
                rent.max(0.0)
            } else {
                nearest_rent(rent, weight, &lists, shares)
            };
            for members in lists {
                let level = level(members, shares_of(&self.tolls), weight + rent);
                for share in members {
                    let share = &mut self.tolls.shares[*share];
                    *share = (*share - level).max(0.0);
                }
            }
            self.tolls.rents[thing] = rent;
        }
    }

    /// The present tolls as whole numbers, where these close the case.
    fn whole(&self, limit: i64) -> Option<Closing> {
        SCALES.iter().find_map(|scale| {
            let units = *scale as f64;
            let near = |list: &[f64]| -> Vec<i64> {
                list.iter().map(|one| (one * units).round() as i64).collect()
            };
            let below = |one: &f64| (one * units + 1e-6).floor() as i64;
            let mut rents = near(&self.tolls.rents);
            // A price that no device pays says nothing.
            for (rent, owned) in rents.iter_mut().zip(&self.case.owned) {
                *rent *= i64::from(*owned);
            }
            let tolls = Tolls {
                rents,
                shares: self.tolls.shares.iter().map(below).collect(),
                streams: near(&self.tolls.streams),
            };
            if !writable(self.weighed, &tolls, *scale) {
                return None;
            }
            let bound = self.weighed.bound(self.case, self.open, &tolls, *scale);
            (bound > limit.saturating_mul(*scale)).then(|| {
                let mut used: Vec<usize> = self.case.members.iter().flatten().copied().collect();
                used.sort_unstable();
                used.dedup();
                Closing { scale: *scale, tolls, used }
            })
        })
    }
}

/// Whether all numbers have the 32 bits of the format.
fn writable(weighed: &Weighed<'_>, tolls: &Tolls<i64>, scale: i64) -> bool {
    let prices = weighed.of_things.iter().zip(&tolls.rents);
    let prices = prices.map(|(weight, rent)| *weight as i64 * scale + rent);
    let mut all = prices.chain(tolls.shares.iter().chain(&tolls.streams).copied());
    all.all(|toll| u32::try_from(toll).is_ok())
}

fn shares_of(tolls: &Tolls<f64>) -> &[f64] {
    &tolls.shares
}

fn dot(a: &Tolls<f64>, b: &Tolls<f64>) -> f64 {
    let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    product(&a.rents, &b.rents) + product(&a.shares, &b.shares) + product(&a.streams, &b.streams)
}

/// What each member pays less so that all together pay no more than `most`.
fn level(members: &[usize], shares: &[f64], most: f64) -> f64 {
    let mut paid: Vec<f64> = members.iter().map(|share| shares[*share]).collect();
    if paid.iter().sum::<f64>() <= most {
        return 0.0;
    }
    paid.sort_by(|a, b| b.total_cmp(a));
    let (mut sum, mut level) = (0.0, 0.0);
    for (count, one) in (1_u32..).zip(paid) {
        sum += one;
        let even = (sum - most) / f64::from(count);
        if count > 1 && even >= one {
            break;
        }
        level = even;
    }
    level
}

/// The rent from which all lie nearest: the rent as it is, the classes as they would have to
/// come down for it.
fn nearest_rent(rent: f64, weight: f64, classes: &[&[usize]], shares: &[f64]) -> f64 {
    let pull = |at: f64| {
        let levels = classes.iter().map(|members| level(members, shares, weight + at));
        rent - at + levels.sum::<f64>()
    };
    let most =
        classes.iter().map(|members| members.iter().map(|share| shares[*share]).sum::<f64>());
    let (mut low, mut high) = (0.0, most.fold(rent, |most, sum| most.max(sum - weight)).max(0.0));
    if pull(low) <= 0.0 {
        return 0.0;
    }
    for _ in 0..30 {
        let middle = 0.5 * (low + high);
        if pull(middle) > 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    high
}
