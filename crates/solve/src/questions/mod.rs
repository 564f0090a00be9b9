//! The questions that can be asked of a problem, one file each, and what only they need.

pub(crate) mod conflict;
pub(crate) mod count;
pub(crate) mod enumerate;
mod known_sets;
mod placements;
mod sharing;
pub(crate) mod solve;
