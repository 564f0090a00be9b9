//! What a search looks for, what it has found, and how far it has come.

use super::Found;
use crate::model::Choices;

/// How long a question is worth asking.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Effort {
    /// So many nodes of the search.
    Nodes(u64),
    /// Until it is answered.
    Any,
}

impl Effort {
    fn is_spent(self, nodes: u64) -> bool {
        matches!(self, Self::Nodes(most) if nodes > most)
    }
}

/// What is looked for, and the best that is found.
#[derive(Debug)]
pub(crate) struct Goal {
    /// Only answers below this are looked for.
    pub(crate) limit: u64,
    /// Only answers above this are looked for.
    pub(crate) floor: Option<u64>,
    /// Whether the first one is enough.
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
    /// Whether an answer of this weight is looked for at all.
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

    /// Whether nothing more is looked for.
    pub(crate) fn is_reached(&self) -> bool {
        self.first && self.best.is_some()
    }
}

/// How far the search has come, and how far it may go.
#[derive(Debug)]
pub(crate) struct Progress {
    pub(crate) nodes: u64,
    /// Nodes when the present search began.
    begun: u64,
    /// Nodes until which any answer will do, so that there is a limit to bound against.
    pub(crate) dive_until: Option<u64>,
    pub(crate) effort: Effort,
    pub(crate) stopped: bool,
}

impl Progress {
    /// Goes on after so many nodes.
    pub(crate) fn after(nodes: u64) -> Self {
        Self { nodes, begun: 0, dive_until: None, effort: Effort::Any, stopped: false }
    }

    pub(crate) fn begin(&mut self) {
        self.begun = self.nodes;
    }

    /// Nodes of the present search.
    pub(crate) fn of_this_search(&self) -> u64 {
        self.nodes - self.begun
    }

    /// So many nodes from here, if the effort allows as many.
    pub(crate) fn more(&self, nodes: u64) -> Effort {
        let until = self.nodes + nodes;
        match self.effort {
            Effort::Nodes(most) => Effort::Nodes(most.min(until)),
            Effort::Any => Effort::Nodes(until),
        }
    }

    pub(crate) fn is_spent(&self) -> bool {
        self.effort.is_spent(self.nodes)
    }
}
