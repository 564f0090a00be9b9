//! Host applications: generated for a corpus of designs, compiled with each available compiler, and
//! run against the shared wire vectors, on a pseudo-terminal, and with the real middleware if
//! available.
//!
//! Tests whose tools are missing are skipped with a notice (`SKIPPED: …` on stderr); with
//! `SENSEDSL_REQUIRE_TOOLS=1`, a missing tool that package registries have is a failure. The trees
//! of other projects are taken from `LIBCLUON` (folder of `cluon-complete.hpp`), `OPENDAVINCI`
//! (prefix of an installed OpenDaVINCI 4) and `OPENDAVINCI2014` (`libopendavinci/include`, and for
//! running, `lib/libopendavinci.a` and `bin/supercomponent`).

mod c;
mod compile;
pub(crate) mod designs;
pub(crate) mod files;
mod health;
mod link;
mod matlab;
mod middleware;
mod page;
mod played;
mod python;
mod ros2;
mod rust;
mod shown;
pub(crate) mod terminal;
pub(crate) mod tools;
mod units;
mod vectors;
