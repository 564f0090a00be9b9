//! The known parts, from outside: their table, and requests on them.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::indexing_slicing,
    clippy::disallowed_methods,
    reason = "a test may panic, and asks the environment how much is wanted"
)]

mod complete;
mod designs;
mod families;
mod memory;
mod remap;
mod requests;
mod table;
mod traps;
