//! Measures the solver on seeded families of problems.

fn main() {}
