//! The runtime of Rust firmware on Embassy: what lies between [`sense_rt`], which knows no hardware,
//! and the drivers of a HAL.
//!
//! In: tables of constants and typed peripherals, both printed by a generator. Out: tasks' bodies,
//! the link to the host, and how the board is. A program has one HAL, which a feature chooses; its
//! folder has modules of the same names as the others, so that what is printed is the same for all:
//!
//! | feature | HAL | folder |
//! | --- | --- | --- |
//! | `stm32` | `embassy-stm32` | `src/stm32` |
//! | `esp` | `esp-hal` | `src/esp` |
//! | `nrf` | `embassy-nrf` | `src/nrf` |
//! | `rp` | `embassy-rp` | `src/rp` |
//!
//! Further features say which versions of a unit the MCU has: `can-banks` or `can-fd`, `i2c-v1` or
//! `i2c-v2`, `usart-v1` or `usart-v3`, `adc-v2`, `gpio-v2`, `otg`, `pcnt`. The HALs themselves
//! are dependencies for MCUs alone, so `no-hal` leaves the folders out where all features are on;
//! everything else is compiled and tested on a computer.
//!
//! # Example
//!
//! ```
//! use sense_embassy::devices::{Devices, Report as _};
//! use sense_rt::{Checksum, Item, Outcome, Scalar, Schema};
//!
//! static SCHEMA: Schema = Schema {
//!     items: &[Item::sensor(17, Scalar::Uint16, 1)],
//!     hash: 7,
//!     stamp: false,
//!     checksum: Checksum::None,
//! };
//! static BOARD: Devices<2, 1> = Devices::new(&SCHEMA, &[10]);
//!
//! BOARD.report(None, 0, Outcome::Fresh, &mut 500_u16.to_be_bytes());
//! BOARD.with(|store, _| assert_eq!(store.get(0), Some(&[1, 0xf4][..])));
//! ```
#![no_std]

#[cfg(feature = "runtime")]
pub mod analog;
#[cfg(feature = "runtime")]
pub mod bus;
#[cfg(feature = "runtime")]
pub mod capture;
#[cfg(feature = "runtime")]
pub mod contact;
#[cfg(feature = "runtime")]
pub mod control;
#[cfg(feature = "runtime")]
pub mod devices;
#[cfg(feature = "runtime")]
pub mod line;
#[cfg(feature = "runtime")]
pub mod link;
#[cfg(feature = "runtime")]
pub mod link_stream;
#[cfg(feature = "runtime")]
pub mod link_uart;
#[cfg(feature = "runtime")]
pub mod link_usb;
#[cfg(feature = "runtime")]
pub mod onewire;
#[cfg(feature = "runtime")]
pub mod serial;
#[cfg(all(
    any(feature = "esp", feature = "nrf", feature = "rp", feature = "stm32"),
    not(feature = "no-hal")
))]
pub mod status;

#[cfg(all(feature = "esp", not(feature = "no-hal")))]
mod esp;
#[cfg(all(feature = "esp", not(feature = "no-hal")))]
pub use esp::*;
#[cfg(all(feature = "nrf", not(feature = "no-hal")))]
mod nrf;
#[cfg(all(feature = "nrf", not(feature = "no-hal")))]
pub use nrf::*;
#[cfg(all(feature = "rp", not(feature = "no-hal")))]
mod rp;
#[cfg(all(feature = "rp", not(feature = "no-hal")))]
pub use rp::*;
#[cfg(all(feature = "stm32", not(feature = "no-hal")))]
mod stm32;
#[cfg(all(feature = "stm32", not(feature = "no-hal")))]
pub use stm32::*;

#[cfg(feature = "runtime")]
mod time;
#[cfg(feature = "runtime")]
pub use time::{now_ms, queue};

#[cfg(feature = "sources")]
#[path = "../sources.rs"]
pub mod sources;

/// Starts a task. There is one of each, so there is always room for it; a program that is wrong
/// about that starts over.
#[macro_export]
macro_rules! start {
    ($spawner:ident, $task:expr) => {
        match $task {
            Ok(token) => $spawner.spawn(token),
            Err(_) => $crate::restart(),
        }
    };
}
