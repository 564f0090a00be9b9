//! An emulated MCU that runs a program as it is.
//!
//! In comes an image (`Machine::load`) and what a host sends; out go what the host receives, and events. The core,
//! its interrupt controller and its exceptions are rsemu's (`core.rs`); everything else on the chip is here, a file a
//! device (`chip.rs`), and which of them an MCU has is data (`mcu.rs`). What the pads are connected to says [`Surroundings`](sensedsl_surroundings::Surroundings).
//!
//! The core counts cycles of its own clock, all else nanoseconds; where the core waits in a loop of one instruction the
//! time jumps to the next event. Nothing here reads a clock or draws numbers, so a run is the same each time.
//!
//! Without the feature `cpu` the crate is empty: rsemu takes a minute or two to compile, and only what runs an image needs
//! it.
//!
//! Not modelled: wait states, the write buffer, noise, the time that the DMA takes, the analog and digital filters.

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
mod gpio;
mod i2c;
mod image;
mod iwdg;
mod lockup;
mod map;
mod mcu;
mod plain;
mod ports;
mod rcc;
mod spi;
#[cfg(test)]
mod tests;
mod timer;
mod transfer;
mod usart;
mod usb;
mod usb_host;
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

/// What of a board the machine has to know.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Settings {
    /// The crystal's frequency in Hz.
    pub crystal_hz: u64,
    /// Which port the host computer is connected to.
    pub link: LinkPort,
    /// What it is.
    pub mcu: &'static Mcu,
}

/// The emulated MCU.
pub struct Machine {
    core: Core,
}

impl Machine {
    /// An MCU without a program, in its surroundings. The caller keeps its own handle of them.
    #[must_use]
    pub fn new(settings: Settings, surroundings: Arc<Mutex<dyn Surroundings>>) -> Self {
        Self { core: Core::new(settings, surroundings) }
    }

    /// Puts a program into the flash and switches the power on: time begins at 0.
    ///
    /// # Errors
    ///
    /// When it is not a program for this MCU.
    pub fn load(&mut self, image: &[u8]) -> Result<(), ImageError> {
        let flash = image::flash_of(image, self.core.mcu())?;
        self.core.load(&flash);
        Ok(())
    }

    /// Runs until a time, or a few cycles longer.
    pub fn run_until(&mut self, end_ns: u64) {
        self.core.run_until(end_ns);
    }

    /// The time.
    #[must_use]
    pub fn now_ns(&self) -> u64 {
        self.core.chip().wires.now
    }

    /// How many cycles the core has worked, without those that it waited.
    #[must_use]
    pub fn cycles_worked(&self) -> u64 {
        self.core.cycles_worked()
    }

    /// How many instructions the core has executed, without those of a loop of one in which it waited.
    #[must_use]
    pub fn instructions(&self) -> u64 {
        self.core.executed()
    }

    /// The host sends: bytes arrive at the line's speed.
    pub fn link_write(&mut self, bytes: &[u8]) {
        self.core.chip().wires.link.to_mcu.extend(bytes);
    }

    /// A program of the host opens the port, or closes it. Only a host over USB can tell the board.
    pub fn link_open(&mut self, is_open: bool) {
        self.core.chip().wires.link.is_open = is_open;
    }

    /// How many bytes of the host's have not arrived yet.
    #[must_use]
    pub fn link_waiting(&self) -> usize {
        self.core.chip().wires.link.to_mcu.len()
    }

    /// What the host received since the last time, each byte with the time when it was there.
    pub fn link_read(&mut self) -> Vec<(u64, u8)> {
        std::mem::take(&mut self.core.chip().wires.link.from_mcu)
    }

    /// How each pad is set up now.
    #[must_use]
    pub fn pads(&self) -> Vec<PadState> {
        self.core.chip().wires.gpio.pads()
    }

    /// How each port is set up that has started.
    #[must_use]
    pub fn ports(&self) -> Vec<PortState> {
        self.core.chip().ports()
    }

    /// From a feeding of the watchdog to its bite; none where it does not run.
    #[must_use]
    pub fn watchdog_ns(&self) -> Option<u64> {
        self.core.chip().watchdog_ns()
    }

    /// The core's frequency in Hz, as the clock tree is set now.
    #[must_use]
    pub fn core_hz(&self) -> u64 {
        self.core.chip().wires.clocks.core
    }

    /// What happened since the last time that a user wants to hear of.
    pub fn events(&mut self) -> Vec<Event> {
        std::mem::take(&mut self.core.chip().wires.events)
    }

    /// Takes the supply away, or gives it back: as after a brown-out the program begins anew, and memory is lost.
    pub fn power(&mut self, is_on: bool) {
        self.core.power(is_on);
    }

    /// Whether the core will do nothing more until a reset, and why. The watchdog may still bite.
    #[must_use]
    pub fn halt(&self) -> Option<Lockup> {
        self.core.lockup()
    }

    /// The address of the instruction that comes next.
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
