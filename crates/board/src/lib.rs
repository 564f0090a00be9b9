//! What the hardware offers: board tables, built-in boards and target profiles.
//!
//! Text comes in (a CSV table of the user, or the files of `boards/`, `silicon/` and `targets/` that
//! are part of the binary); typed pins, signals, boards and profiles go out. This crate knows no `.sense`
//! file and does no I/O. A board table never fails to load: [`table::load`] returns what was
//! understood and a list of [`finding::Finding`]s, each with its place in the text.

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
