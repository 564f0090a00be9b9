//! The tables of a part in C.

use askama::Template;
use sensedsl_files::block;
use sensedsl_job::part::{FieldCoding, PartPlan};

use crate::words as c;

/// What only the wiring of a part says, and only its tables in C are told.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Wiring {
    /// Which DMA fills and empties its buffer.
    pub buffer: DmaBuffer,
    /// The number of its chip select; none where its address selects it.
    pub select: Option<u8>,
}

/// A buffer, by the DMA controllers that must reach it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum DmaBuffer {
    /// The main ones.
    #[default]
    Main,
    /// The basic one.
    Basic,
}

#[derive(Template)]
#[template(path = "tables.c.txt", escape = "none")]
struct Tables<'a> {
    p: &'a PartPlan,
    wiring: Wiring,
}

/// The tables of a part in C. They name the fields of the schema `SENSE_FIELD_` and the device's name, as the header of
/// a board does, and the types of `crates/firmware-c/runtime`. The plan is the same for all targets; what only C is
/// told of the wiring comes with it.
#[must_use]
pub fn tables(plan: &PartPlan, wiring: Wiring) -> String {
    block(&Tables { p: plan, wiring })
}
