//! The known parts, from outside: their table, and requests on them.
#![cfg(test)]
#![allow(clippy::disallowed_methods, reason = "a test asks the environment how much is wanted")]

mod complete;
mod designs;
mod families;
mod memory;
mod remap;
mod requests;
mod table;
mod traps;

/// The step through all parts: 1 in a thorough run, otherwise the one that is given.
fn step(quick: usize) -> usize {
    if std::env::var("SENSEDSL_THOROUGH").is_ok() { 1 } else { quick }
}
