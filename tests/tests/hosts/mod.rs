//! Host applications: generated for a corpus of designs, compiled by each compiler at hand, run
//! against the shared wire vectors, on a pseudo-terminal, and with the real middleware where it is.
//!
//! What a machine may lack is skipped loudly (`SKIPPED: …` on stderr); with `SENSEDSL_REQUIRE_TOOLS=1`
//! a tool that package registries have is then a failure. Trees of other projects are taken from
//! `LIBCLUON` (folder of `cluon-complete.hpp`), `OPENDAVINCI` (prefix of an installed OpenDaVINCI 4)
//! and `OPENDAVINCI2014` (`libopendavinci/include`, and for running `lib/libopendavinci.a` and
//! `bin/supercomponent`).

mod compile;
mod designs;
mod files;
mod health;
mod link;
mod middleware;
mod page;
mod shown;
pub(crate) mod terminal;
pub(crate) mod tools;
mod units;
mod vectors;
