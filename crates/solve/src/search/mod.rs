//! Branch and bound: domains in, the cheapest complete choice below a limit out.
//!
//! Each node propagates, bounds by the flow, and tries to read a wiring off the flow. Where that
//! fails, it bounds by prices, tries the wiring that the linear program comes nearest to
//! ([`crate::search::strong_branching`]), and branches ([`crate::search::branching`]): on what the program leaves open, or on the
//! choice at fault. The best answer is looked for little above the bound first, then farther up.
#![expect(clippy::indexing_slicing, reason = "all ids come from the model")]

pub(crate) mod branching;
pub(crate) mod canonical;
pub(crate) mod read_off;
pub(crate) mod strong_branching;
pub(crate) mod tie_break;

use crate::bounds::dualized::Dualized;
use crate::bounds::flow::{Flow, Saved};
use crate::bounds::lagrangian::Lagrangian;
use crate::bounds::relaxation::Relaxation;
use crate::cancel::Cancel;
use crate::domains::{Dead, Domains};
use crate::model::Model;
use crate::problem::Problem;
use crate::questions::solve::Effort;
use crate::search::branching::Branch;
use crate::search::read_off::Scratch;
use crate::search::strong_branching::PseudoCosts;

/// Alternative and candidates of each device, by id.
pub(crate) type Choices = Vec<(usize, Vec<usize>)>;

/// The search and all its domains.
pub(crate) struct Engine<'a> {
    pub(crate) problem: &'a Problem,
    pub(crate) model: &'a Model,
    pub(crate) domains: Domains,
    pub(crate) flow: Flow,
    /// Only answers below this are looked for.
    pub(crate) limit: u64,
    /// Whether the first one is enough.
    first: bool,
    pub(crate) best: Option<(u64, Choices)>,
    /// Only answers above this are looked for.
    pub(crate) floor: Option<u64>,
    pub(crate) nodes: u64,
    pub(crate) cancel: Cancel<'a>,
    pub(crate) effort: Effort,
    pub(crate) stopped: bool,
    pub(crate) scratch: Scratch,
    /// The second bound, made when the flow is not enough.
    pub(crate) prices: Option<Box<Prices>>,
    /// Nodes until which any answer will do, so that there is a limit to bound against.
    dive: u64,
    /// Nodes when the present search began.
    begun: u64,
    /// No answer of the present search is below this.
    pub(crate) proved: u64,
    /// Whether what is refused on one board may be refused on all equal ones: all that restricts the
    /// domains says of which boards something is decided.
    pub(crate) mirrors: bool,
}

/// What the price bound needs.
pub(crate) struct Prices {
    pub(crate) terms: Dualized,
    dual: Lagrangian,
    pub(crate) relaxation: Relaxation,
    pub(crate) history: PseudoCosts,
    /// The bound as last assessed.
    pub(crate) bound: u64,
}

/// An engine without what it borrows, to be kept between two steps of an iterator.
pub(crate) struct Parked {
    domains: Domains,
    flow: Flow,
    nodes: u64,
    scratch: Scratch,
    prices: Option<Box<Prices>>,
}

/// How long the search looks for a first answer by the flow alone, beside a node for each device
/// where any answer will do.
const DIVE: u64 = 10;

/// Nodes of a mere question that are spent on the flow alone.
const PATIENCE: u64 = 3;

/// Steps of the simplex method at one node.
const LP_STEPS: usize = 5_000;

impl<'a> Engine<'a> {
    /// # Errors
    /// [`Dead`] when propagation alone shows that there is no answer.
    pub(crate) fn new(
        problem: &'a Problem,
        model: &'a Model,
        cancel: Cancel<'a>,
    ) -> Result<Self, Dead> {
        Ok(Self {
            problem,
            model,
            domains: Domains::new(model)?,
            flow: Flow::new(model),
            limit: u64::MAX,
            first: false,
            best: None,
            floor: None,
            nodes: 0,
            cancel,
            effort: Effort::Any,
            stopped: false,
            scratch: Scratch::new(problem.resources as usize, model.pins),
            prices: None,
            dive: 0,
            begun: 0,
            proved: 0,
            mirrors: false,
        })
    }

    pub(crate) fn park(self) -> Parked {
        let Self { domains, flow, nodes, scratch, prices, .. } = self;
        Parked { domains, flow, nodes, scratch, prices }
    }

    pub(crate) fn unpark(
        problem: &'a Problem,
        model: &'a Model,
        parked: Parked,
        cancel: Cancel<'a>,
    ) -> Self {
        let Parked { domains, flow, nodes, scratch, prices } = parked;
        Self {
            problem,
            model,
            domains,
            flow,
            limit: u64::MAX,
            first: false,
            best: None,
            floor: None,
            nodes,
            cancel,
            effort: Effort::Any,
            stopped: false,
            scratch,
            prices,
            dive: 0,
            begun: 0,
            proved: 0,
            mirrors: false,
        }
    }

    /// The cheapest choice below `limit`, or with `first` any one below it.
    pub(crate) fn search(&mut self, limit: u64, first: bool) -> Option<(u64, Choices)> {
        self.limit = limit.min(self.model.most);
        self.first = first;
        self.best = None;
        let mark = self.domains.mark();
        let saved = self.flow.save();
        self.begun = self.nodes;
        if limit == u64::MAX {
            let devices = if first { self.model.devices as u64 } else { 0 };
            self.dive = self.nodes + devices + DIVE;
            self.node(0);
            self.dive = 0;
            self.back(mark, &saved);
        }
        if first {
            if self.best.is_none() {
                self.node(0);
            }
        } else if let Ok(bound) = self.root() {
            self.back(mark, &saved);
            self.climb(bound);
        }
        self.back(mark, &saved);
        self.best.take()
    }

    /// The bound of the whole search.
    fn root(&mut self) -> Result<u64, Dead> {
        self.settle()?;
        if self.bound() >= self.limit {
            return Err(Dead);
        }
        self.price()?;
        let bound = self.prices.as_ref().map_or(0, |prices| prices.bound);
        Ok(bound.max(self.bound()).max(self.floor.map_or(0, |floor| floor + 1)))
    }

    /// Looks for answers little above the bound first, then farther and farther up: what would be
    /// too dear is struck early, and no search goes on long below a bad answer.
    fn climb(&mut self, bound: u64) {
        let mark = self.domains.mark();
        let saved = self.flow.save();
        let most = self.limit;
        let mut step = self.model.weights.cost;
        self.proved = bound;
        while self.proved < most && !self.stopped {
            let goal = bound.saturating_add(step).min(most);
            self.limit = goal;
            self.node(0);
            self.back(mark, &saved);
            if self.limit < goal {
                break;
            }
            if !self.stopped {
                self.proved = goal;
            }
            step = step.saturating_mul(2);
        }
    }

    /// The cheapest choice that costs more than `floor`.
    pub(crate) fn search_above(&mut self, floor: u64) -> Option<(u64, Choices)> {
        self.floor = Some(floor);
        let found = self.search(u64::MAX, false);
        self.floor = None;
        found
    }

    pub(crate) fn bound(&self) -> u64 {
        self.domains.paid + self.flow.cost()
    }

    /// Propagates and updates the bound.
    pub(crate) fn settle(&mut self) -> Result<(), Dead> {
        self.domains.propagate(self.model)?;
        self.flow.refresh(self.model, &self.domains)
    }

    pub(crate) fn back(&mut self, mark: usize, saved: &Saved) {
        self.domains.undo(self.model, mark);
        self.flow.restore(saved);
    }

    /// Searches below the current domains; leaves them smaller.
    fn node(&mut self, depth: usize) {
        loop {
            self.nodes += 1;
            if self.dive > 0 && (self.best.is_some() || self.nodes > self.dive) {
                return;
            }
            self.stopped |= self.effort.is_spent(self.nodes) || self.cancel.is_over();
            if self.stopped || self.settle().is_err() {
                return;
            }
            let bound = self.bound();
            if bound >= self.limit {
                return;
            }
            if self.model.dma_matters && !self.dma_possible() {
                return;
            }
            let Some(mut branch) = self.try_wiring(bound) else { return };
            if self.prices_now() {
                match self.price() {
                    Err(Dead) => return,
                    Ok(true) => continue,
                    Ok(false) => {}
                }
                let limit = self.limit;
                self.round();
                if self.limit < limit {
                    if self.first || depth > 0 {
                        return;
                    }
                    continue;
                }
                branch = match self.guided(branch) {
                    Err(Dead) => return,
                    Ok(None) => continue,
                    Ok(Some(guided)) => guided,
                };
            }
            let limit = self.limit;
            let refused = self.follow(branch, depth);
            if refused.is_err() || self.first && self.best.is_some() {
                return;
            }
            // A better limit strikes more at the root than anywhere below it.
            if self.limit < limit && !self.first && depth > 0 {
                return;
            }
        }
    }

    /// Whether it is time for the second bound.
    fn prices_now(&self) -> bool {
        self.dive == 0
            && (!self.first || self.prices.is_some() || self.nodes > self.begun + PATIENCE)
    }

    /// Reads a wiring off the flow and keeps it if it is better; what to branch on, if anything.
    fn try_wiring(&mut self, bound: u64) -> Option<Branch> {
        let choices = match self.read() {
            Ok(choices) => choices,
            Err(branch) => return branch,
        };
        let weight = self.model.evaluate(&choices);
        let toll = self.open_toll(&choices);
        let counts = self.floor.is_none_or(|floor| weight > floor);
        if counts && weight < self.limit {
            self.limit = weight;
            self.best = Some((weight, choices));
        }
        if self.first && self.best.is_some() || counts && weight == bound {
            return None;
        }
        toll.or_else(|| self.any_branch())
    }

    /// Searches where the branch is taken, then refuses it here (unless the limit has improved,
    /// which makes the root start again, or the first answer was enough).
    fn follow(&mut self, branch: Branch, depth: usize) -> Result<(), Dead> {
        let mark = self.domains.mark();
        let saved = self.flow.save();
        let limit = self.limit;
        if self.take(branch).is_ok() {
            self.node(depth + 1);
        }
        if self.first && self.best.is_some() {
            return Ok(());
        }
        self.back(mark, &saved);
        if self.limit < limit && !self.first { Ok(()) } else { self.refuse(branch) }
    }

    /// Strikes all that cannot be in an answer below the limit, for good.
    pub(crate) fn narrow(&mut self, limit: u64) -> Result<(), Dead> {
        self.limit = limit;
        self.settle()?;
        while self.prices.is_some() && !self.stopped && self.price()? {
            self.settle()?;
        }
        Ok(())
    }

    /// Bounds by prices; whether they narrowed the domains.
    fn price(&mut self) -> Result<bool, Dead> {
        self.bound_by_prices(LP_STEPS)?;
        let (model, limit) = (self.model, self.limit);
        let Some(prices) = &mut self.prices else { return Ok(false) };
        prices.dual.strike(&prices.terms, model, &mut self.domains, limit)
    }

    /// The bound by the best prices that so many steps find, as the linear program sees it.
    pub(crate) fn bound_by_prices(&mut self, steps: usize) -> Result<f64, Dead> {
        let (problem, model) = (self.problem, self.model);
        let prices = self.prices.get_or_insert_with(|| {
            let terms = Dualized::new(problem, model);
            let dual = Lagrangian::new(&terms);
            let relaxation = Relaxation::new(&terms, model, &self.domains);
            let history = PseudoCosts::default();
            Box::new(Prices { terms, dual, relaxation, history, bound: 0 })
        });
        let Prices { terms, dual, relaxation, bound, .. } = &mut **prices;
        let unused = |f: &usize| terms.facilities[*f].alts.iter().all(|&a| !self.domains.alt_on(a));
        if self.domains.opened.iter().any(unused) {
            return Err(Dead);
        }
        let most = Lagrangian::most(terms, model, &self.domains, self.limit).ok_or(Dead)?;
        relaxation.run(terms, model, &self.domains, dual, (most, steps, self.cancel));
        *bound = dual.assess(terms, model, &self.domains);
        if *bound >= self.limit {
            return Err(Dead);
        }
        Ok(relaxation.worth())
    }
}
