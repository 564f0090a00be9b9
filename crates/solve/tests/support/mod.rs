//! What the tests share: problems from board tables, and an oracle that tries everything.
#![allow(dead_code, reason = "each test binary uses its part")]

pub mod board;
pub mod brute;
