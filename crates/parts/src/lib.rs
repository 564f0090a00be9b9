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
mod shipped;

pub use complete::{Completion, complete};
pub use find::{Found, find, nearest_name};
pub use listing::{Part, all};
pub use sheet::{Sheet, Usage};
pub use shipped::packed_bytes;
