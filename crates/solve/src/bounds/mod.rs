//! Lower bounds: the domains of a node in, a weight below which no answer lies out.
//!
//! Two relaxations. [`flow`] is cheap and runs at every node. [`lagrangian`] is sharper: it judges
//! multipliers that a linear program ([`relaxation`], [`program`], [`lp`]) finds.

pub(crate) mod dualized;
pub(crate) mod flow;
pub(crate) mod lagrangian;
pub(crate) mod lp;
pub(crate) mod program;
pub(crate) mod relaxation;
mod subproblems;
