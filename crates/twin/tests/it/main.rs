//! Boards that do their job in this program, and the judge that compares their reports with the world.
#![allow(missing_docs, reason = "tests need none")]
#![cfg(test)]
#![allow(clippy::disallowed_methods, reason = "a test reads the examples")]

mod boards;
mod commanded;
mod judged;
mod kinds;
mod lamps;
mod library;
mod mistakes;
mod motors;
mod plants;
mod ranges;
mod run;
mod stand_ins;
#[cfg(feature = "machine")]
mod watched;
mod worlds;

/// The step through many cases: 1 in a thorough run, otherwise the one that is given.
fn step(quick: usize) -> usize {
    if std::env::var("SENSEDSL_THOROUGH").is_ok() { 1 } else { quick }
}
