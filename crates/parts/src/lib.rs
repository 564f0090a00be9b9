//! MCU parts: a part number in, its pins, usages, package, positions, cores and memory out.
//!
//! The facts are one compressed table, made by `cargo xtask parts` from packages of public
//! registries (see `data/README.md`); RP2040 and RP2350 are rules. The table is unpacked at the
//! first question. This crate complements the built-in boards of `sensedsl-board`, on which it
//! depends: a name is looked up there first and here second. A table that lists no usages takes
//! them from here.
//!
//! # Example
//!
//! ```
//! use sensedsl_board::pin::PinName;
//! use sensedsl_parts::{find, nearest_name};
//!
//! let found = find("stm32f407vgt6").unwrap();
//! assert_eq!((found.mcu.as_str(), found.package()), ("STM32F407VGT6", Some("LQFP100")));
//!
//! let (position, usages) = found.sheet.pin(&PinName::parse("PA1").unwrap()).unwrap();
//! assert_eq!(position, Some("24"));
//! assert!(usages.contains(&("TIM2_CH2".to_owned(), Some(1))));
//!
//! assert_eq!(nearest_name("STM32F407VGT66").as_deref(), Some("STM32F407VGT6"));
//! ```

mod complete;
mod find;
pub mod format;
mod listing;
pub mod rp;
mod sheet;

use std::sync::OnceLock;

pub use complete::{Completion, complete};
pub use find::{Found, find, nearest_name};
pub use listing::{Part, all};
pub use sheet::{Sheet, Usage};

use format::Data;

/// The table as it is shipped.
const PACKED: &[u8] = include_bytes!("../data/parts.bin");

/// The unpacked table; empty should the shipped one be damaged, which tests rule out.
pub(crate) fn data() -> &'static Data {
    static DATA: OnceLock<Data> = OnceLock::new();
    DATA.get_or_init(|| format::unpack(PACKED).unwrap_or_default())
}

/// Bytes of the table in the binary.
#[must_use]
pub const fn packed_bytes() -> usize {
    PACKED.len()
}
