//! Firmware: the runtime's core, compiled for host and Cortex-M and run against the shared wire
//! vectors, both with sanitizers and on an emulated Cortex-M4; and generated applications built
//! with ChibiOS. The core is also compiled for AVR and run on a simulated one.
//!
//! Tests whose tools are missing are skipped with a notice (`SKIPPED: …` on stderr); with
//! `SENSEDSL_REQUIRE_TOOLS=1`, a missing tool that package registries have is a failure. `CHIBIOS`
//! names a ChibiOS 21.11 source tree, which no registry has: without it, generated applications are
//! read but not built.

mod analog;
mod applications;
pub(crate) mod avr;
mod building;
mod can_bits;
mod chibios;
mod codecs;
mod core;
mod details;
mod drives;
pub(crate) mod embassy;
mod emulated;
mod facts;
mod less;
mod mutants;
mod pins_and_clocks;
mod stubs;
pub(crate) mod tools;
#[cfg(feature = "machine")]
mod twin;
