//! The code that the tests share: problems from board tables, and an oracle that tries everything.
#![allow(dead_code, unreachable_pub, missing_docs, reason = "each test binary uses its part")]
#![allow(clippy::indexing_slicing, clippy::expect_used, clippy::panic, reason = "only tests")]

pub mod board;
pub mod brute;
pub mod generate;
pub mod json;
