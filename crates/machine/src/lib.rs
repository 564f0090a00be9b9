//! An emulated MCU that runs an unmodified program.
//!
//! In: an image (`Machine::load`), and what a host sends. Out: what the host receives, and events. The core, its
//! interrupt controller and its exceptions are rsemu's (`core.rs`). Everything else on the chip is here, with a file
//! for each version of each device (`chip.rs`); data tell which of them an MCU has (`mcu.rs`). The pads are connected
//! to [`Surroundings`](sensedsl_surroundings::Surroundings).
//!
//! Of rsemu's models of ST's devices none is used. They have neither converters, CAN units nor a USB device, and they
//! know ports and RCC of STM32F4 and later families only. They advance in ticks of rsemu's own machine, where here the
//! time jumps from event to event. What is outside of the MCU would still have to be led from each of their pads to
//! [`Surroundings`](sensedsl_surroundings::Surroundings), whichever peripheral the program has put there.
//!
//! The core counts cycles of its own clock, everything else nanoseconds. While the core waits in a loop of one
//! instruction, the time jumps to the next event. Nothing here reads a clock or draws random numbers, so a run is the
//! same each time.
//!
//! Without the feature `cpu` the crate is empty: rsemu takes a minute or two to compile, and only running an image
//! needs it.
//!
//! Not modelled: wait states, the write buffer, noise, the time that the DMA takes, the analog and digital filters.
//!
//! # Example
//!
#![cfg_attr(feature = "cpu", doc = "```")]
#![cfg_attr(not(feature = "cpu"), doc = "```ignore")]
//! use std::sync::{Arc, Mutex};
//!
//! use sensedsl_machine::{LinkPort, Machine, Mcu, Settings};
//! use sensedsl_surroundings::Surroundings;
//!
//! struct Nothing;
//! impl Surroundings for Nothing {}
//!
//! let mcu = Mcu::find("STM32F407VGT6").unwrap();
//! let settings = Settings { crystal_hz: 8_000_000, link: LinkPort::Serial(2), mcu };
//! let mut machine = Machine::new(settings, Arc::new(Mutex::new(Nothing)));
//! // The stack, the address of the first instruction, and `b .`, which waits for ever.
//! let words = [0x2002_0000_u32, 0x0800_0009, 0xE7FE];
//! let image: Vec<u8> = words.into_iter().flat_map(u32::to_le_bytes).collect();
//! machine.load(&image).unwrap();
//! machine.run_until(1_000_000);
//! assert!(machine.now_ns() >= 1_000_000);
//! assert_eq!((machine.pc(), machine.halt()), (0x0800_0008, None));
//! ```

#![cfg(feature = "cpu")]
#![expect(
    clippy::indexing_slicing,
    reason = "registers are decoded from addresses that `map` has found, units from tables of their number"
)]
#![expect(
    clippy::wildcard_enum_match_arm,
    reason = "most registers and devices have no part in most questions"
)]

mod adc;
mod can;
mod capture;
mod chip;
mod core;
mod dac;
mod dma;
mod exti;
mod fdcan;
mod gpio;
mod i2c;
mod image;
mod iwdg;
mod line;
mod lockup;
mod map;
mod mcu;
mod plain;
mod ports;
mod rcc;
mod registers;
mod spi;
#[cfg(test)]
mod tests;
mod timer;
mod transfer;
mod usart;
mod usb;
mod wires;

use std::sync::{Arc, Mutex};

pub use gpio::{Mode, PadState, Pull};
pub use image::ImageError;
pub use lockup::Lockup;
pub use mcu::Mcu;
pub use ports::{PortState, Setting};
pub use wires::{Event, LinkPort, ResetCause};

use self::core::Core;
use sensedsl_surroundings::Surroundings;

/// The settings of the machine that come from the board.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Settings {
    /// The crystal's frequency in Hz.
    pub crystal_hz: u64,
    /// The port that the host computer is connected to.
    pub link: LinkPort,
    /// The MCU.
    pub mcu: &'static Mcu,
}

/// The emulated MCU.
pub struct Machine {
    core: Core,
}

impl Machine {
    /// An MCU without a program, in its surroundings. The caller keeps its own handle to them.
    #[must_use]
    pub fn new(settings: Settings, surroundings: Arc<Mutex<dyn Surroundings>>) -> Self {
        Self { core: Core::new(settings, surroundings) }
    }

    /// Puts a program into the flash and switches the power on: time begins at 0.
    ///
    /// # Errors
    ///
    /// If it is not a program for this MCU.
    pub fn load(&mut self, image: &[u8]) -> Result<(), ImageError> {
        let flash = image::flash_of(image, self.core.mcu())?;
        self.core.load(&flash);
        Ok(())
    }

    /// Runs until a time, or a few cycles longer.
    pub fn run_until(&mut self, end_ns: u64) {
        self.core.run_until(end_ns);
    }

    /// The virtual time in nanoseconds.
    #[must_use]
    pub fn now_ns(&self) -> u64 {
        self.core.chip().wires.now
    }

    /// The number of cycles that the core has worked, without those that it waited.
    #[must_use]
    pub fn cycles_worked(&self) -> u64 {
        self.core.cycles_worked()
    }

    /// The number of instructions that the core has executed, without those of one-instruction loops in which it
    /// waited.
    #[must_use]
    pub fn instructions(&self) -> u64 {
        self.core.executed()
    }

    /// The host sends bytes, which arrive at the line's speed.
    pub fn link_write(&mut self, bytes: &[u8]) {
        self.core.chip().wires.link.to_mcu.extend(bytes);
    }

    /// A program on the host opens or closes the port. Only a host over USB can let the board know.
    pub fn link_open(&mut self, is_open: bool) {
        self.core.chip().wires.link.is_open = is_open;
    }

    /// The bytes that the host has received since the last call, each with the time of its arrival.
    pub fn link_read(&mut self) -> Vec<(u64, u8)> {
        std::mem::take(&mut self.core.chip().wires.link.from_mcu)
    }

    /// The present settings of all pads.
    #[must_use]
    pub fn pads(&self) -> Vec<PadState> {
        self.core.chip().wires.gpio.pads()
    }

    /// The settings of the ports that have started.
    #[must_use]
    pub fn ports(&self) -> Vec<PortState> {
        self.core.chip().ports()
    }

    /// The time from a reload of the watchdog to its reset; `None` if it does not run.
    #[must_use]
    pub fn watchdog_ns(&self) -> Option<u64> {
        self.core.chip().watchdog_ns()
    }

    /// The core's frequency in Hz, with the present settings of the clock tree.
    #[must_use]
    pub fn core_hz(&self) -> u64 {
        self.core.chip().wires.clocks.core
    }

    /// The events since the last call that matter to a user.
    pub fn events(&mut self) -> Vec<Event> {
        std::mem::take(&mut self.core.chip().wires.events)
    }

    /// What is around the MCU may have other edges to come than those that it was asked for.
    pub fn surroundings_changed(&mut self) {
        self.core.chip().wires.version += 1;
    }

    /// Takes the supply away or gives it back: as after a brown-out, the program starts again and memory is lost.
    pub fn power(&mut self, is_on: bool) {
        self.core.power(is_on);
    }

    /// Whether the core is stuck until a reset, and why. The watchdog may still reset it.
    #[must_use]
    pub fn halt(&self) -> Option<Lockup> {
        self.core.lockup()
    }

    /// The address of the next instruction.
    #[must_use]
    pub fn pc(&self) -> u32 {
        self.core.pc()
    }

    /// The causes of resets in `RCC_CSR`, bits 25 to 31, until the program clears them.
    #[must_use]
    pub fn reset_causes(&self) -> u32 {
        self.core.chip().rcc.causes()
    }
}
