//! Boards that do their job in this program, and the judge that compares their reports with the world.
#![allow(missing_docs, reason = "tests need none")]
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::indexing_slicing,
    clippy::disallowed_methods,
    reason = "a test may panic, and reads the examples"
)]

mod boards;
mod commanded;
mod judged;
mod kinds;
mod library;
mod mistakes;
mod ranges;
mod run;
#[cfg(feature = "machine")]
mod watched;
mod worlds;
