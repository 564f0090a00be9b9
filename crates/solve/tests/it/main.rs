//! The solver from outside, against an oracle that tries everything and against the paper's table.

#[path = "../support/mod.rs"]
mod support;

mod brute;
mod inside;
mod neat;
mod table1;
