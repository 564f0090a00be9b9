//! What profiles of STM32 keep for this HAL: versions of units, the tree of clocks, units that move to other pins.

use serde::Deserialize;

use super::clock::Clock;
use crate::names::Names;

/// The settings of one line.
#[derive(Clone, Debug)]
pub(super) struct Settings {
    pub(super) file: File,
    pub(super) line: Line,
}

/// The keys of `[system]`.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct File {
    /// How a converter is made and read.
    pub(super) adc: Adc,
    /// The version of the I²C units.
    i2c: String,
    /// The version of the serial ports.
    usart: String,
    /// The register that has the causes of the last reset from bit 26 on; `None` if another register has them.
    #[serde(default)]
    pub(super) reset: Option<String>,
    /// The driver of the CAN controllers.
    can: Can,
    /// Whether units, not pins, decide on which pins their signals are.
    pub(super) afio: bool,
    /// The units that move as a whole.
    remaps: Vec<RemapEntry>,
}

/// The keys of a line.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Line {
    /// How the firmware sets the clocks; `None` if it keeps those of the reset.
    pub(super) clock: Option<Clock>,
}

/// How the converters are used.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Adc {
    pub(super) new: AdcNew,
    pub(super) read: AdcRead,
}

/// What a converter is made of besides its unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum AdcNew {
    /// Nothing.
    Unit,
    /// Its interrupt.
    Interrupt,
    /// A resolution.
    Resolution,
    /// A configuration.
    Default,
}

/// How an input is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum AdcRead {
    /// By waiting in a loop.
    Blocking,
    /// By the runtime's sampler, which the interrupt drives; the HAL would wait in a loop.
    Sampler,
    /// By its interrupt.
    Async,
}

/// The HAL's drivers of CAN controllers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Can {
    Bxcan,
    Fdcan,
    None,
}

/// A unit that moves to other pins as a whole.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RemapEntry {
    name: String,
    #[serde(default)]
    lines: Vec<String>,
    remap: Remap,
}

/// The type that says to which pins it moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Remap {
    Number,
    Switch,
}

impl Settings {
    /// Reads the keys of a profile; the error says what is wrong with them.
    pub(super) fn of(names: &Names) -> Result<Self, String> {
        let mut file: File = names.settings()?;
        file.remaps.retain(|one| names.fits(&one.lines));
        Ok(Self { file, line: names.line_settings()? })
    }

    /// How a unit moves; `None` if it never does.
    pub(super) fn remap(&self, unit: &str) -> Option<Remap> {
        self.file.remaps.iter().find(|one| one.name == unit).map(|one| one.remap)
    }

    /// Whether the serial ports have one data register for both directions, and a status that reading clears.
    pub(super) fn has_old_ports(&self) -> bool {
        matches!(self.file.usart.as_str(), "v1" | "v2")
    }

    /// The feature of `sense-embassy` for the version of the serial ports.
    pub(super) fn port_feature(&self) -> &'static str {
        if self.has_old_ports() { "usart-v1" } else { "usart-v3" }
    }

    /// Whether the profile has no version of the I²C units.
    pub(super) fn lacks_buses(&self) -> bool {
        self.file.i2c.is_empty()
    }

    /// Whether a reset of the I²C units takes their settings.
    pub(super) fn has_old_buses(&self) -> bool {
        self.file.i2c == "v1"
    }

    /// Whether the profile has no driver of the CAN controllers.
    pub(super) fn lacks_can(&self) -> bool {
        self.file.can == Can::None
    }

    /// Whether the CAN controllers are those with filter banks.
    pub(super) fn has_can_banks(&self) -> bool {
        self.file.can == Can::Bxcan
    }

    /// Whether pins can be pulled up while a unit uses them.
    pub(super) fn has_pulls(&self) -> bool {
        !self.file.afio
    }
}
