//! Generated files, read by a compiler with our own stub headers (`tests/firmware/stubs`) in place
//! of ChibiOS, so that no tree is needed. `families` has every family of MCUs with every kind,
//! `library` has every driver of the library and every example, and `refused` has mistakes that the
//! stubs must not accept.
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
