//! Lower bounds: from the domains of a node, a weight below which there is no answer.
//!
//! There are two relaxations. [`flow`] is cheap and runs at every node. [`lagrangian`] is sharper:
//! it evaluates the multipliers that a linear program ([`relaxation`], [`program`], [`lp`]) finds.

pub(crate) mod dualized;
pub(crate) mod flow;
pub(crate) mod lagrangian;
pub(crate) mod lp;
pub(crate) mod program;
pub(crate) mod relaxation;
mod subproblems;
