//! How Embassy's HAL spells what a profile knows: chips, peripherals, DMA channels, interrupts, remaps.
//!
//! In: what a profile keeps for this target's generator. Out: [`Names`] of one line of MCUs.

use std::collections::BTreeMap;

use sensedsl_board::profile::TargetProfile;
use serde::Deserialize;

use super::clock::Clock;
use super::hal::Hal;
use super::rp::Start;

/// The names of one line of MCUs.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Names {
    /// Whose HAL it is.
    #[serde(default)]
    pub(super) hal: Hal,
    /// How the chips of [`Hal::Rp`] start.
    #[serde(default)]
    pub(super) start: Start,
    /// The triple that the Rust compiler knows the core by.
    pub(super) target: String,
    /// How a converter is made and read.
    pub(super) adc: Adc,
    /// The version of the I²C units.
    i2c: String,
    /// The version of the serial ports.
    usart: String,
    /// The register that tells the cause of the last reset from bit 26 on; `None` if another register does.
    #[serde(default)]
    pub(super) reset: Option<String>,
    /// The driver of the CAN controllers.
    can: Can,
    /// How a DMA channel is called.
    dma: String,
    /// Whether peripherals, not pins, decide on which pins their signals are.
    pub(super) afio: bool,
    #[serde(rename = "source")]
    _source: String,
    peripherals: Vec<Peripheral>,
    remaps: Vec<RemapEntry>,
    interrupts: Vec<Interrupts>,
    /// What the line states.
    #[serde(skip)]
    pub(super) line: Line,
    #[serde(skip)]
    line_name: String,
}

/// How the HAL's converters are used.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Adc {
    pub(super) new: AdcNew,
    pub(super) read: AdcRead,
}

/// What a converter is made of beside its unit.
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
    /// Its interrupt and a configuration.
    Config,
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
    /// By its interrupt; the conversion may have failed.
    Checked,
}

/// The HAL's drivers of CAN controllers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Can {
    Bxcan,
    Fdcan,
    None,
}

/// A unit that the HAL calls otherwise.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Peripheral {
    name: String,
    #[serde(default)]
    lines: Vec<String>,
    hal: String,
}

/// A unit that is moved to other pins as a whole.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct RemapEntry {
    name: String,
    #[serde(default)]
    lines: Vec<String>,
    remap: Remap,
}

/// The type by which the HAL is told to which pins.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Remap {
    Number,
    Switch,
}

/// The interrupts of a unit by signal.
#[derive(Clone, Debug, Deserialize)]
struct Interrupts {
    name: String,
    #[serde(default)]
    lines: Vec<String>,
    #[serde(flatten)]
    of: BTreeMap<String, String>,
}

/// What a line states.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Line {
    /// The HAL's features of the chips; `*` where it must be told how many banks the flash is.
    chips: String,
    /// Interrupts that no unit in use has.
    pub(super) spare: Vec<String>,
    /// How the firmware sets the clocks; `None` if it keeps those of the reset, or the HAL sets them.
    pub(super) clock: Option<Clock>,
    /// The HAL's feature for the line, where it is not the chip's name.
    feature: Option<String>,
    /// What a debug probe calls the chip, where it is not the feature's name.
    probe: Option<String>,
}

/// A chip of the HAL.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Chip {
    /// Its feature: `stm32f407vg`.
    pub feature: String,
    /// Whether the HAL must be told how many banks its flash is.
    pub banks: bool,
    /// What debug probes call it: `STM32F407VG`.
    pub probe: String,
}

impl Names {
    /// Reads what a profile keeps for this target.
    ///
    /// # Errors
    ///
    /// What is wrong with it.
    pub fn of(profile: &TargetProfile) -> Result<Self, String> {
        let file = toml::Value::Table(profile.own.file.clone());
        let names: Self = file.try_into().map_err(|error: toml::de::Error| error.to_string())?;
        let line = toml::Value::Table(profile.own.line.clone());
        let line: Line = line.try_into().map_err(|error: toml::de::Error| error.to_string())?;
        Ok(Self { line, line_name: profile.line.clone(), ..names })
    }

    /// What is wrong with the names of a profile.
    pub(super) fn problems(&self, profile: &TargetProfile) -> Vec<String> {
        let mut problems = Vec::new();
        if self.line.chips.split_whitespace().next().is_none() {
            problems.push(format!("{}: no chips", profile.line));
        }
        if self.i2c.is_empty() && !profile.i2cs.is_empty() {
            problems.push(format!("{}: I2C units without a version", profile.line));
        }
        if self.can == Can::None && !profile.cans.is_empty() {
            problems.push(format!("{}: CAN controllers without a driver", profile.line));
        }
        for timer in &profile.timers {
            if timer.icu.is_some() && self.interrupt(&timer.name, "CC").is_none() {
                problems.push(format!("{}: {} has no interrupt", profile.line, timer.name));
            }
        }
        for unit in &profile.i2cs {
            if self.interrupt(&unit.name, "EV").is_none() {
                problems.push(format!("{}: {} has no interrupt", profile.line, unit.name));
            }
        }
        problems
    }

    /// The chip of an MCU: `stm32f407vg` of `STM32F407VGT6`.
    #[must_use]
    pub fn chip(&self, mcu: &str) -> Option<Chip> {
        let wanted = mcu.to_ascii_lowercase();
        let chips = self.line.chips.split_whitespace();
        let fits = chips.filter(|chip| {
            let name = chip.trim_end_matches('*');
            let name = name.split('-').next().unwrap_or(name);
            wanted.starts_with(name)
        });
        let found = fits.max_by_key(|chip| chip.len())?;
        let chip = found.trim_end_matches('*');
        let feature = self.line.feature.as_deref().unwrap_or(chip);
        let probe = self.line.probe.clone().unwrap_or_else(|| feature.to_uppercase());
        Some(Chip { feature: feature.to_owned(), banks: found.ends_with('*'), probe })
    }

    /// What the HAL calls a unit.
    #[must_use]
    pub fn peripheral<'a>(&'a self, unit: &'a str) -> &'a str {
        // A unit without a number is the only one of its kind.
        let wanted = if unit == "CAN" { "CAN1" } else { unit };
        let own = |one: &&Peripheral| one.name == wanted && self.fits(&one.lines);
        self.peripherals.iter().find(own).map_or(unit, |one| one.hal.as_str())
    }

    /// What the HAL calls a DMA channel: `DMA1_CH0` of `1,0`. None where it has no such channel by number, as for
    /// the basic controllers of H7.
    #[must_use]
    pub fn channel(&self, stream: &str) -> Option<String> {
        let (controller, stream) = stream.split_once(',')?;
        let name = self.dma.replace("{controller}", controller).replace("{stream}", stream);
        self.interrupts.iter().any(|one| one.name == name).then_some(name)
    }

    /// The interrupt of a unit, a DMA channel or a line.
    #[must_use]
    pub fn interrupt(&self, unit: &str, signal: &str) -> Option<&str> {
        let wanted = if unit == "CAN" { "CAN1" } else { unit };
        let own = |one: &&Interrupts| one.name == wanted && self.fits(&one.lines);
        let found = self.interrupts.iter().find(own)?;
        found.of.get(signal).map(String::as_str)
    }

    /// The type of a unit's remap to a block; none where every pin has a choice of its own.
    #[must_use]
    pub fn remap(&self, unit: &str, block: u8) -> Option<String> {
        if !self.afio {
            return None;
        }
        let wanted = if unit == "CAN" { "CAN1" } else { unit };
        let own = |one: &&RemapEntry| one.name == wanted && self.fits(&one.lines);
        Some(match self.remaps.iter().find(own).map(|one| one.remap) {
            Some(Remap::Number) => format!("hal::gpio::AfioRemap<{block}>"),
            Some(Remap::Switch) => format!("hal::gpio::AfioRemapBool<{}>", block > 0),
            None => "hal::gpio::AfioRemapNotApplicable".to_owned(),
        })
    }

    /// Whether the serial ports have one register for the bytes of both directions, and a status that reading clears.
    pub(super) fn has_old_ports(&self) -> bool {
        matches!(self.usart.as_str(), "v1" | "v2")
    }

    /// The feature of `sense-embassy` for the version of the serial ports; none where a HAL has one version.
    pub(super) fn port_feature(&self) -> Option<&'static str> {
        let version = if self.has_old_ports() { "usart-v1" } else { "usart-v3" };
        (self.hal == Hal::Stm32).then_some(version)
    }

    /// Whether the units for I²C lose their settings when they are to forget what they were doing.
    pub(super) fn has_old_buses(&self) -> bool {
        self.i2c == "v1"
    }

    /// Whether the CAN controllers are those with filter banks.
    pub(super) fn has_can_banks(&self) -> bool {
        self.can == Can::Bxcan
    }

    /// Whether pins in use by a unit can be pulled up.
    pub(super) fn has_pulls(&self) -> bool {
        !self.afio
    }

    fn fits(&self, lines: &[String]) -> bool {
        lines.is_empty() || lines.contains(&self.line_name)
    }
}
