//! A board's work and the other end of its link, independent of any system or language.
//!
//! In: a design and its wiring. Out: a [`BoardJob`] for each board, and one [`host::HostPlan`] for all of them. A
//! system that firmware is generated for implements [`Target`], a host application implements [`host::Host`], each in
//! its own crate.

pub mod host;
mod job;
pub mod kinds;
mod names;
pub mod part;
mod target;

pub use job::*;
pub use names::snake;
pub use target::Target;
