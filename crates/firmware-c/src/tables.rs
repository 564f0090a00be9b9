//! The tables of a part in C.

use askama::Template;
use sensedsl_files::block;
use sensedsl_job::part::{FieldCoding, PartPlan};

use crate::words as c;

/// The facts of a part's wiring, which only its tables in C contain.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Wiring {
    /// The kind of DMA that fills and empties its buffer.
    pub buffer: DmaBuffer,
    /// The number of its chip select, or that on its wire; `None` if its address selects it.
    pub select: Option<u8>,
    /// Whether all parts use the same memory, `up_work` and `up_scratch`, because one after the other is served.
    pub shares_memory: bool,
}

/// The DMA controllers that must reach a buffer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum DmaBuffer {
    /// The main controllers.
    #[default]
    Main,
    /// The basic controller.
    Basic,
}

#[derive(Template)]
#[template(path = "tables.c.txt", escape = "none")]
struct Tables<'a> {
    p: &'a PartPlan,
    wiring: Wiring,
}

/// The tables of a part in C. They refer to the fields of the schema as `SENSE_FIELD_` and the device's name, as the
/// header of a board does, and to the types of `crates/firmware-c/runtime`. The plan is the same for all targets;
/// `wiring` adds what only C needs.
#[must_use]
pub fn tables(plan: &PartPlan, wiring: Wiring) -> String {
    block(&Tables { p: plan, wiring })
}
