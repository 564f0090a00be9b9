//! ChibiOS firmware: tables for the hand-written runtime, configuration as changes to the user's tree.
//!
//! In: a design and its wiring. Out: for each board that carries a device a folder with a Makefile,
//! `cfg/`, `generated/`, `user/` and a copy of the runtime. Everything is decided in [`plan`] (one
//! file per concern), from the target profile's data; the templates only print. What the hardware
//! or this generator cannot do comes back as diagnostics, and then there is no plan.

mod analog;
mod board;
mod context;
mod guards;
mod i2c;
mod icu;
mod link;
mod plan;
mod render;
mod runtime;
mod schema;
mod settings;
mod tasks;

pub use plan::{FirmwarePlan, has_templates, plan};
pub use render::render;
