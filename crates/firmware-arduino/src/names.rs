//! How the framework spells what a profile describes: numbers of pins, objects of ports, registers of interrupts.
//!
//! In: the part of a profile for this target. Out: [`Names`].

use sensedsl_board::catalog;
use sensedsl_board::pin::PinName;
use sensedsl_board::profile::TargetProfile;
use serde::Deserialize;

/// The `system` of a line.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Names {
    /// What the compiler and the programmer call the MCU.
    pub mcu: String,
    /// What tools call the usual board with it.
    pub board: BoardNames,
    /// The program memory that a boot loader leaves.
    pub flash_bytes: u32,
    /// The memory for data.
    pub ram_bytes: u32,
    /// What the framework keeps of it for each port that is named.
    pub uart_buffers_bytes: u32,
    /// The memory that keeps data without supply.
    pub eeprom_bytes: u32,
    /// Timers whose capture input keeps the time of an edge.
    pub capture_timers: Vec<String>,
    external: Vec<String>,
    banks: Vec<String>,
    pins: String,
    select: String,
    ports: Vec<Port>,
}

/// What tools call a board: the line's, or `[system.arduino]` of a board's file.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BoardNames {
    /// PlatformIO's name: `uno`.
    pub platformio: String,
    /// The Arduino IDE's and `arduino-cli`'s: `arduino:avr:uno`.
    pub fqbn: String,
    /// The folder of the core that says where its pins are.
    pub variant: String,
    /// The macro that tells sketches the board, behind `ARDUINO_`.
    pub name: String,
    /// How the boot loader takes programs, as avrdude calls it.
    pub protocol: String,
    /// At how many baud.
    pub speed: u32,
    /// Vendor and product of a USB port of its own.
    pub usb: Option<[u32; 2]>,
}

impl BoardNames {
    /// Those of a board, which may have none of its own.
    ///
    /// # Errors
    ///
    /// What is wrong in the board's file.
    pub fn of(board: &catalog::Board) -> Result<Option<Self>, String> {
        let Some(facts) = board.system.get("arduino") else { return Ok(None) };
        facts.own.clone().try_into().map(Some).map_err(|error: toml::de::Error| error.to_string())
    }
}

/// A serial port.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Port {
    name: String,
    object: String,
}

/// Where an edge at a pin interrupts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Interrupt {
    /// An interrupt of its own.
    External,
    /// The interrupt that it shares with other pins, and its bit among them.
    Bank {
        /// The number of the interrupt.
        number: usize,
        /// The bit of the pin.
        bit: usize,
    },
}

impl Names {
    /// The names of a profile's line.
    ///
    /// # Errors
    ///
    /// What is wrong in the file.
    pub fn of(profile: &TargetProfile) -> Result<Self, String> {
        profile.own.line.clone().try_into().map_err(|error: toml::de::Error| error.to_string())
    }

    /// The mistakes in the data.
    pub(crate) fn problems(&self) -> Vec<String> {
        let banks = self.banks.iter().flat_map(|bank| bank.split_whitespace());
        let all = self.pins.split_whitespace().chain(banks);
        let all = all.chain(self.external.iter().map(String::as_str));
        let all = all.chain(std::iter::once(self.select.as_str()));
        all.filter(|name| PinName::parse(name).is_none())
            .map(|name| format!("`{name}` is no pin"))
            .collect()
    }

    /// The number of a pin in the framework.
    pub(crate) fn number(&self, pin: &PinName) -> Option<u8> {
        let at = self.pins.split_whitespace().position(|name| name == pin.as_str())?;
        u8::try_from(at).ok()
    }

    /// The number of a pin as an analog input: some have another one for that, which stands behind all others.
    pub(crate) fn analog_number(&self, pin: &PinName) -> Option<u8> {
        let all: Vec<&str> = self.pins.split_whitespace().collect();
        u8::try_from(all.iter().rposition(|name| *name == pin.as_str())?).ok()
    }

    /// The interrupt of a pin.
    pub(crate) fn interrupt(&self, pin: &PinName) -> Option<Interrupt> {
        if self.external.iter().any(|name| name == pin.as_str()) {
            return Some(Interrupt::External);
        }
        self.banks.iter().enumerate().find_map(|(number, bank)| {
            let bit = bank.split_whitespace().position(|name| name == pin.as_str())?;
            Some(Interrupt::Bank { number, bit })
        })
    }

    /// The object of a serial port.
    pub(crate) fn object(&self, unit: &str) -> Option<&str> {
        let port = self.ports.iter().find(|port| port.name == unit)?;
        Some(&port.object)
    }

    /// The pin that makes the SPI unit a slave when it is an input and low.
    pub(crate) fn select(&self) -> &str {
        &self.select
    }
}
