//! What is generated, read by a compiler with stub headers of ours (`tests/firmware/stubs`) in the place of
//! ChibiOS: no tree is needed. `families` has every family of MCUs with every kind, `library` every driver of the
//! library and every example, `refused` mistakes that the stubs must not let through.
//!
//! This proves agreement with the stubs, not with ChibiOS.

mod compiler;
mod designs;
mod families;
mod library;
mod refused;
mod same;

pub(crate) use compiler::{compile, macros_of, profile_of, sources};
pub(crate) use designs::codes;
