//! Firmware: the runtime's core compiled for host and Cortex-M, run against the shared wire vectors
//! with sanitizers and on an emulated Cortex-M4; and generated applications built with ChibiOS.
//!
//! What a machine may lack is skipped loudly (`SKIPPED: …` on stderr); with `SENSEDSL_REQUIRE_TOOLS=1`
//! a tool that package registries have is then a failure. `CHIBIOS` names a ChibiOS 21.11 source
//! tree, which no registry has: without it the generated applications are only looked at.

mod analog;
mod applications;
mod building;
mod can_bits;
mod chibios;
mod codecs;
mod core;
mod details;
mod embassy;
mod emulated;
mod facts;
mod mutants;
mod pins_and_clocks;
mod stubs;
mod tools;
#[cfg(feature = "machine")]
mod twin;
