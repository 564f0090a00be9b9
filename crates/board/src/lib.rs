//! The hardware: board tables, built-in boards and target profiles.
//!
//! Text goes in: a user's CSV table, or the files of `boards/`, `silicon/` and `targets/`, which
//! are part of the binary. Typed pins, signals, boards and profiles come out. This crate does not
//! read `.sense` files and does no I/O. A board table never fails to load: [`table::load`] returns
//! what was understood and a list of [`finding::Finding`]s, each with its place in the text.
//!
//! # Example
//!
//! ```
//! use sensedsl_board::pin::PinName;
//! use sensedsl_board::{catalog, table};
//!
//! let loaded = table::load("Pin,ADC,TIM\nPA1,ADC1-IN1,TIM2_CH2 TIM5_CH2\nPA1,-,-\n");
//! let pa1 = loaded.board.pin(&PinName::parse("pa1").unwrap()).unwrap();
//! assert_eq!(pa1.usages[0].signal.name(), "ADC1_IN1");
//! assert_eq!(pa1.cost(), 3);
//! // The second row of the pin is left out and reported.
//! assert_eq!(loaded.findings[0].row, 3);
//!
//! let discovery = catalog::find("stm32f4-discovery-board").unwrap();
//! assert_eq!(discovery.table().mcu.as_deref(), Some("STM32F407VGT6"));
//! ```

pub mod catalog;
pub mod cells;
mod entry;
pub mod finding;
pub mod form;
pub mod landmark;
mod load;
pub mod mcu;
pub mod pin;
pub mod place;
pub mod profile;
mod registry;
pub mod remap;
pub mod signal;
pub mod silicon;
pub mod table;
