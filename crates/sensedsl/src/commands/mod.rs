//! The commands, with a file for each.

pub(crate) mod boards;
pub(crate) mod build;
pub(crate) mod capacity;
pub(crate) mod check;
mod deadline;
pub(crate) mod diff;
pub(crate) mod drivers;
pub(crate) mod explain;
mod facts;
pub(crate) mod flash;
pub(crate) mod fmt;
pub(crate) mod generate;
pub(crate) mod help;
pub(crate) mod import;
mod in_the_way;
mod input;
pub(crate) mod new;
mod output;
pub(crate) mod parts;
pub(crate) mod simulate;
pub(crate) mod solve;
mod starter;
mod sweep;
mod table;
mod timing;
mod typecheck;
mod why;
