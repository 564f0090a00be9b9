//! Branch and bound: domains in, the cheapest complete choice below a limit out.
//!
//! The scheme is that of A. H. Land and A. G. Doig, *An automatic method of solving discrete
//! programming problems*, 1960. Each node ([`node`]) propagates, bounds by the flow, and tries to
//! read a wiring off the flow ([`read_off`]). If that fails, it bounds by prices, tries the wiring
//! nearest to the solution of the linear program ([`rounding`]), and branches ([`branching`]) on
//! what the program leaves fractional ([`strong_branching`]), or on the choice at fault.
//!
//! Once there is an answer, the search for the best one begins just above the bound and goes
//! farther up from there, with limits that grow as in iterative deepening (R. E. Korf, *Depth-first
//! iterative-deepening*, 1985).

pub(crate) mod branch;
pub(crate) mod branching;
pub(crate) mod canonical;
mod node;
mod progress;
mod pseudo_costs;
mod read_off;
pub(crate) mod recorded;
mod rounding;
mod strong_branching;
pub(crate) mod tie_break;
#[cfg(feature = "inside")]
#[expect(
    missing_docs,
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test says by its name what it holds, and may panic"
)]
pub(crate) mod worked_example;

pub(crate) use self::progress::{Budget, Effort, Found, Goal, Progress};

pub(crate) use self::pseudo_costs::PseudoCosts;
use self::read_off::Holders;
use crate::bounds::dualized::Dualized;
use crate::bounds::flow::{Flow, Saved};
use crate::bounds::lagrangian::Lagrangian;
use crate::bounds::relaxation::Relaxation;
use crate::cancel::Cancel;
use crate::domains::{Domains, Pruned};
use crate::model::{Choices, Model};
use crate::problem::Problem;

/// The search and all its state.
pub(crate) struct Engine<'a> {
    pub(crate) problem: &'a Problem,
    pub(crate) model: &'a Model,
    pub(crate) cancel: Cancel<'a>,
    pub(crate) domains: Domains,
    pub(crate) flow: Flow,
    holders: Holders,
    /// The second bound, made when the flow is not enough.
    pub(crate) pricing: Option<Box<Pricing>>,
    /// Experience from an earlier search of the same problem; the second bound starts with it.
    pub(crate) learned: PseudoCosts,
    pub(crate) goal: Goal,
    pub(crate) progress: Progress,
    /// Whether a choice may be refused on all equal boards at once. It may while every restriction
    /// of the domains marks the boards that it is about.
    pub(crate) board_symmetry: bool,
    /// Whether a choice may be refused in all equal bundles at once.
    pub(crate) bundle_symmetry: bool,
}

/// The state of the Lagrangian bound.
pub(crate) struct Pricing {
    pub(crate) dualized: Dualized,
    lagrangian: Lagrangian,
    pub(crate) relaxation: Relaxation,
    pseudo_costs: PseudoCosts,
    /// The bound as last assessed.
    pub(crate) bound: u64,
}

/// An engine without what it borrows, to be kept between two steps of an iterator.
pub(crate) struct Parked {
    domains: Domains,
    flow: Flow,
    holders: Holders,
    pricing: Option<Box<Pricing>>,
    nodes: u64,
}

/// Nodes in which the search looks for a first answer by the flow alone, plus one for each device
/// if any answer will do.
const DIVE: u64 = 10;

/// Nodes in which the search looks for any answer before it looks for the best one.
const ANY: u64 = 200;

/// Nodes that a question of the tie-break may spend near the known answer.
const NEAR: u64 = 30;

/// The distance of the limit from the bound doubles up to this cost.
const NEARLY: u64 = 16;

/// The factor by which it grows beyond that: an answer farther away costs a rule, not a pin.
const LEAP: u64 = 64;

/// The most steps of the simplex method at one node.
const LP_STEPS: usize = 5_000;

impl<'a> Engine<'a> {
    /// # Errors
    /// [`Pruned`] when propagation alone shows that there is no answer.
    pub(crate) fn new(
        problem: &'a Problem,
        model: &'a Model,
        cancel: Cancel<'a>,
    ) -> Result<Self, Pruned> {
        let parked = Parked {
            domains: Domains::new(model)?,
            flow: Flow::new(model),
            holders: Holders::new(problem, model),
            pricing: None,
            nodes: 0,
        };
        Ok(Self::resume(problem, model, parked, cancel))
    }

    pub(crate) fn resume(
        problem: &'a Problem,
        model: &'a Model,
        parked: Parked,
        cancel: Cancel<'a>,
    ) -> Self {
        let Parked { domains, flow, holders, pricing, nodes } = parked;
        Self {
            problem,
            model,
            cancel,
            domains,
            flow,
            holders,
            pricing,
            learned: PseudoCosts::default(),
            goal: Goal::default(),
            progress: Progress::after(nodes),
            board_symmetry: false,
            bundle_symmetry: true,
        }
    }

    pub(crate) fn park(self) -> Parked {
        let Self { domains, flow, holders, pricing, progress, .. } = self;
        Parked { domains, flow, holders, pricing, nodes: progress.nodes }
    }

    /// The cheapest choice below `limit`, or with `first` any one below it.
    pub(crate) fn search(&mut self, limit: u64, first: bool) -> Option<Found> {
        self.aim(limit, first);
        let mark = self.domains.mark();
        let saved = self.flow.save();
        self.progress.begin();
        if limit == u64::MAX {
            let devices = if first { self.model.devices.len() as u64 } else { 0 };
            self.dive(devices + DIVE);
        }
        if first {
            if self.goal.best.is_none() {
                self.node(0);
            }
        } else if let Ok(bound) = self.root_bound() {
            self.back(mark, &saved);
            if limit == u64::MAX && self.goal.best.is_none() {
                self.find_any();
            }
            self.deepen(bound);
        }
        self.back(mark, &saved);
        self.goal.best.take()
    }

    /// Any choice below the limit that a few nodes find near a known one.
    pub(crate) fn search_near(&mut self, limit: u64, known: &Choices) -> Option<Found> {
        self.aim(limit, true);
        self.goal.near = Some(known.clone());
        self.within(Effort::Any, |engine| engine.dive(NEAR));
        self.goal.near = None;
        self.goal.best.take()
    }

    fn aim(&mut self, limit: u64, first: bool) {
        self.goal.limit = limit.min(self.model.most);
        self.goal.first = first;
        self.goal.best = None;
    }

    /// Looks for any choice by the flow alone, for at most `nodes` nodes.
    fn dive(&mut self, nodes: u64) {
        let mark = self.domains.mark();
        let saved = self.flow.save();
        self.progress.dive_until = Some(self.progress.nodes + nodes);
        self.node(0);
        self.progress.dive_until = None;
        self.back(mark, &saved);
    }

    /// Looks for any choice, so that there is one early and a limit to bound against.
    fn find_any(&mut self) {
        let mark = self.domains.mark();
        let saved = self.flow.save();
        self.goal.first = true;
        self.within(self.progress.more(ANY), |engine| engine.node(0));
        self.goal.first = false;
        self.back(mark, &saved);
    }

    /// Searches with at most this effort, then restores the old one. Also returns whether the
    /// effort was too little.
    fn within<T>(&mut self, effort: Effort, search: impl FnOnce(&mut Self) -> T) -> (T, bool) {
        let all = std::mem::replace(&mut self.progress.effort, effort);
        let found = search(self);
        self.progress.effort = all;
        let is_spent = self.progress.stopped && !self.cancel.is_over();
        self.progress.stopped &= !is_spent || self.progress.is_spent();
        (found, is_spent)
    }

    /// The cheapest choice that costs more than `floor`.
    pub(crate) fn search_above(&mut self, floor: u64) -> Option<Found> {
        self.goal.floor = Some(floor);
        let found = self.search(u64::MAX, false);
        self.goal.floor = None;
        found
    }

    /// The bound of the whole search.
    fn root_bound(&mut self) -> Result<u64, Pruned> {
        self.settle()?;
        if self.bound() >= self.goal.limit {
            return Err(Pruned);
        }
        self.price()?;
        let bound = self.pricing.as_ref().map_or(0, |pricing| pricing.bound);
        Ok(bound.max(self.bound()).max(self.goal.floor.map_or(0, |floor| floor + 1)))
    }

    /// Looks for answers just above the bound first, then farther and farther up: what would be too
    /// expensive is removed early, and no search goes on for long below a bad answer.
    fn deepen(&mut self, bound: u64) {
        let mark = self.domains.mark();
        let saved = self.flow.save();
        let most = self.goal.limit;
        let mut step = self.model.weights.cost;
        self.goal.proved = bound;
        while self.goal.proved < most && !self.progress.stopped {
            let limit = bound.saturating_add(step).min(most);
            self.goal.limit = limit;
            self.node(0);
            self.back(mark, &saved);
            if self.goal.limit < limit {
                break;
            }
            if !self.progress.stopped {
                self.goal.proved = limit;
            }
            let is_near = step < NEARLY * self.model.weights.cost;
            step = step.saturating_mul(if is_near { 2 } else { LEAP });
        }
    }

    /// The bound by the flow.
    pub(crate) fn bound(&self) -> u64 {
        self.domains.paid + self.flow.cost()
    }

    /// Propagates and updates the bound by the flow.
    pub(crate) fn settle(&mut self) -> Result<(), Pruned> {
        self.domains.propagate(self.model)?;
        self.flow.refresh(self.model, &self.domains)
    }

    pub(crate) fn back(&mut self, mark: usize, saved: &Saved) {
        self.domains.undo(self.model, mark);
        self.flow.restore(saved);
    }

    /// Removes everything that cannot be in an answer below the limit, for good.
    pub(crate) fn narrow(&mut self, limit: u64) -> Result<(), Pruned> {
        self.goal.limit = limit;
        self.settle()?;
        while self.pricing.is_some() && !self.progress.stopped && self.price()? {
            self.settle()?;
        }
        Ok(())
    }

    /// Like [`Self::narrow`], but prices only once: a question that prices can answer is answered
    /// quickly.
    pub(crate) fn narrow_once(&mut self, limit: u64) -> Result<(), Pruned> {
        self.goal.limit = limit;
        self.progress.step();
        self.settle()?;
        self.price()?;
        self.settle()
    }

    /// Bounds by prices, and returns whether they narrowed the domains.
    fn price(&mut self) -> Result<bool, Pruned> {
        self.bound_by_prices(LP_STEPS)?;
        let (model, limit) = (self.model, self.goal.limit);
        let Some(pricing) = &mut self.pricing else { return Ok(false) };
        pricing.lagrangian.fix(&pricing.dualized, model, &mut self.domains, limit)
    }

    /// Bounds by the best prices that `steps` steps find. Returns the bound as the linear program
    /// sees it.
    pub(crate) fn bound_by_prices(&mut self, steps: usize) -> Result<f64, Pruned> {
        let (problem, model, domains) = (self.problem, self.model, &self.domains);
        let learned = &self.learned;
        let pricing = self
            .pricing
            .get_or_insert_with(|| Box::new(Pricing::new(problem, model, domains, learned)));
        let Pricing { dualized, lagrangian, relaxation, bound, .. } = &mut **pricing;
        let unused = |f| dualized.facilities[f].alts.iter().all(|&alt| !domains.has_alt(alt));
        if domains.opened.iter().any(|f| unused(*f)) {
            return Err(Pruned);
        }
        let most = Lagrangian::most(dualized, model, domains, self.goal.limit).ok_or(Pruned)?;
        relaxation.run(dualized, model, domains, lagrangian, (most, steps, self.cancel));
        self.progress.work += relaxation.take_work();
        *bound = lagrangian.assess(dualized, model, domains);
        if *bound >= self.goal.limit {
            return Err(Pruned);
        }
        Ok(relaxation.bound())
    }
}

impl Pricing {
    /// Its experience with branches.
    pub(crate) const fn pseudo_costs(&self) -> &PseudoCosts {
        &self.pseudo_costs
    }

    fn new(problem: &Problem, model: &Model, domains: &Domains, learned: &PseudoCosts) -> Self {
        let dualized = Dualized::new(problem, model);
        let lagrangian = Lagrangian::new(&dualized);
        let relaxation = Relaxation::new(&dualized, model, domains);
        let pseudo_costs = learned.clone();
        Self { dualized, lagrangian, relaxation, pseudo_costs, bound: 0 }
    }
}
