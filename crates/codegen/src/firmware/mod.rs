//! Firmware: the program on the board. A system is a folder here and its two lines: the module, and one of [`TARGETS`].

pub mod c;
pub mod chibios;
pub mod embassy;

use crate::target::Target;

/// Every system, in the order in which people read of them.
pub const TARGETS: &[&dyn Target] = &[&chibios::Chibios, &embassy::Embassy];
