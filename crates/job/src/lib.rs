//! What is to run on a board and at the other end of its link, in words that name no system and no language.
//!
//! In: a design and its wiring. Out: a [`BoardJob`] for each board, a [`host::HostPlan`] for all of them. A system
//! that firmware is generated for implements [`Target`], a host application [`host::Host`], each in a crate of its own.

pub mod host;
mod job;
pub mod kinds;
mod names;
pub mod part;
mod target;

pub use job::*;
pub use names::snake;
pub use target::Target;
