//! The hardware: board tables, built-in boards and target profiles.
//!
//! Text goes in: a user's CSV table, or the files of `boards/`, `silicon/` and `targets/`, which
//! are part of the binary. Typed pins, signals, boards and profiles come out. This crate does not
//! read `.sense` files and does no I/O. A board table never fails to load: [`table::load`] returns
//! what was understood and a list of [`finding::Finding`]s, each with its place in the text.

pub mod catalog;
pub mod cells;
pub mod finding;
mod load;
pub mod mcu;
pub mod pin;
pub mod profile;
mod registry;
pub mod remap;
pub mod signal;
pub mod silicon;
pub mod table;
