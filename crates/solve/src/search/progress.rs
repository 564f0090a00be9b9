//! The goal of a search, what it has found, and how far it has got.

use crate::model::Choices;

/// The cost of a node without the simplex method, in units of its work: a row of one step takes
/// about 50 ns, a node about 50 us.
const NODE: u64 = 1_000;

/// How much effort a question is worth. It is counted, not timed, so that every machine gives up at
/// the same point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Effort {
    /// This many nodes of the search.
    Nodes(u64),
    /// This much work, of nodes and of the simplex method.
    Work(u64),
    /// Until it is answered.
    Any,
}

/// The work that is left for questions that only make a good answer nicer.
#[derive(Debug)]
pub(crate) struct Budget {
    left: u64,
}

impl Budget {
    /// Work that all questions together are worth, about 100 ms.
    const ALL: u64 = 2_000_000;
    /// Work that one question is worth, about 25 ms.
    const ONE: u64 = 500_000;
    /// Work that each is worth once all is spent: enough for the bounds alone, or for a few nodes.
    const REST: u64 = 3_000;

    pub(crate) fn new() -> Self {
        Self { left: Self::ALL }
    }

    /// The work that the next question is worth.
    pub(crate) fn next(&self) -> u64 {
        Self::ONE.min(self.left).max(Self::REST)
    }

    pub(crate) fn spend(&mut self, work: u64) {
        self.left = self.left.saturating_sub(work);
    }
}

/// A weight, and the choices that have it.
pub(crate) type Found = (u64, Choices);

/// The goal of a search, and the best answer found so far.
#[derive(Debug)]
pub(crate) struct Goal {
    /// The search looks only for answers below this.
    pub(crate) limit: u64,
    /// The search looks only for answers above this.
    pub(crate) floor: Option<u64>,
    /// Whether the first answer is enough.
    pub(crate) first: bool,
    pub(crate) best: Option<Found>,
    /// A complete choice near which the search looks first.
    pub(crate) near: Option<Choices>,
    /// No answer of the present search is below this.
    pub(crate) proved: u64,
}

impl Default for Goal {
    fn default() -> Self {
        Self { limit: u64::MAX, floor: None, first: false, best: None, near: None, proved: 0 }
    }
}

impl Goal {
    /// Whether the search looks for an answer of this weight at all.
    pub(crate) fn counts(&self, weight: u64) -> bool {
        self.floor.is_none_or(|floor| weight > floor)
    }

    /// Keeps an answer that is better than the best one.
    pub(crate) fn offer(&mut self, found: Found) {
        if found.0 < self.limit && self.counts(found.0) {
            self.limit = found.0;
            self.best = Some(found);
        }
    }

    /// Whether the search can end here.
    pub(crate) fn is_reached(&self) -> bool {
        self.first && self.best.is_some()
    }
}

/// How far the search has got, and how far it may go.
#[derive(Debug)]
pub(crate) struct Progress {
    pub(crate) nodes: u64,
    /// The work of nodes and of the simplex method.
    pub(crate) work: u64,
    /// Number of nodes when the present search began.
    begun: u64,
    /// Number of nodes until which any answer will do, so that there is a limit to bound against.
    pub(crate) dive_until: Option<u64>,
    pub(crate) effort: Effort,
    pub(crate) stopped: bool,
}

impl Progress {
    /// Continues after `nodes` nodes.
    pub(crate) fn after(nodes: u64) -> Self {
        Self { nodes, work: 0, begun: 0, dive_until: None, effort: Effort::Any, stopped: false }
    }

    pub(crate) fn begin(&mut self) {
        self.begun = self.nodes;
    }

    /// Counts one more node.
    pub(crate) fn step(&mut self) {
        self.nodes += 1;
        self.work += NODE;
    }

    /// Number of nodes of the present search.
    pub(crate) fn of_this_search(&self) -> u64 {
        self.nodes - self.begun
    }

    /// An effort of this many nodes from here, if the present effort allows as many.
    pub(crate) fn more(&self, nodes: u64) -> Effort {
        let until = self.nodes + nodes;
        match self.effort {
            Effort::Nodes(most) => Effort::Nodes(most.min(until)),
            Effort::Work(_) | Effort::Any => Effort::Nodes(until),
        }
    }

    pub(crate) fn is_spent(&self) -> bool {
        match self.effort {
            Effort::Nodes(most) => self.nodes > most,
            Effort::Work(most) => self.work > most,
            Effort::Any => false,
        }
    }
}
