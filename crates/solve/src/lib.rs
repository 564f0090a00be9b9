//! Exact pin assignment: integers in, a checked answer out.

pub mod answer;
pub mod problem;
