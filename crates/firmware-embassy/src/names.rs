//! How Embassy spells what a profile knows, whichever HAL serves its MCUs: chips, peripherals, DMA channels,
//! interrupts.
//!
//! In: what a profile keeps for this target's generator. Out: [`Names`] of one line of MCUs. Keys that only one HAL
//! reads are handed on to it unread.

use std::collections::BTreeMap;

use sensedsl_board::profile::TargetProfile;
use serde::Deserialize;
use serde::de::DeserializeOwned;

/// The names of one line of MCUs.
#[derive(Clone, Debug, Deserialize)]
pub(super) struct Names {
    /// The HAL that serves the line, by the name of its package.
    pub(super) hal: Option<String>,
    /// The triple by which the Rust compiler knows the core.
    pub(super) target: String,
    /// The pattern of the DMA channels' names.
    dma: String,
    #[serde(rename = "source")]
    _source: String,
    peripherals: Vec<Peripheral>,
    interrupts: Vec<Interrupts>,
    /// The facts of the line.
    #[serde(skip)]
    pub(super) line: Line,
    #[serde(skip)]
    line_name: String,
    /// The keys that only the HAL reads.
    #[serde(flatten)]
    own: toml::Table,
}

/// A unit that has another name in the HAL.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Peripheral {
    name: String,
    #[serde(default)]
    lines: Vec<String>,
    hal: String,
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

/// The facts of a line.
#[derive(Clone, Debug, Default, Deserialize)]
pub(super) struct Line {
    /// The HAL's features for the chips; a `*` behind one means that the HAL must be told how many banks the flash has.
    chips: String,
    /// Interrupts that no unit in use has.
    pub(super) spare: Vec<String>,
    /// The HAL's feature for the line, where it is not the chip's name.
    feature: Option<String>,
    /// What debug probes call the chip, where it is not the feature's name.
    probe: Option<String>,
    /// The keys that only the HAL reads.
    #[serde(flatten)]
    own: toml::Table,
}

/// A chip of the HAL.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Chip {
    /// The HAL's feature for it: `stm32f407vg`.
    pub(super) feature: String,
    /// Whether the HAL must be told how many banks its flash has.
    pub(super) banks: bool,
    /// What debug probes call it: `STM32F407VG`.
    pub(super) probe: String,
}

/// Reads a table as settings of type `T`; the error says what is wrong.
fn read<T: DeserializeOwned>(table: &toml::Table) -> Result<T, String> {
    let value = toml::Value::Table(table.clone());
    value.try_into().map_err(|error: toml::de::Error| error.to_string())
}

impl Names {
    /// Reads what a profile keeps for this target; the error says what is wrong with it.
    pub(super) fn of(profile: &TargetProfile) -> Result<Self, String> {
        let names: Self = read(&profile.own.file)?;
        let line = read(&profile.own.line)?;
        Ok(Self { line, line_name: profile.line.clone(), ..names })
    }

    /// The keys of `[system]` that only the HAL reads, as its settings.
    pub(super) fn settings<T: DeserializeOwned>(&self) -> Result<T, String> {
        read(&self.own)
    }

    /// The keys of the line that only the HAL reads, as its settings.
    pub(super) fn line_settings<T: DeserializeOwned>(&self) -> Result<T, String> {
        read(&self.line.own)
    }

    /// Whether an entry with such `lines` is one of this line.
    pub(super) fn fits(&self, lines: &[String]) -> bool {
        lines.is_empty() || lines.contains(&self.line_name)
    }

    /// What is wrong with the names of a profile, whichever HAL it has.
    pub(super) fn problems(&self, profile: &TargetProfile) -> Vec<String> {
        let is_empty = self.line.chips.split_whitespace().next().is_none();
        is_empty.then(|| format!("{}: no chips", profile.line)).into_iter().collect()
    }

    /// The chip of an MCU: `stm32f407vg` of `STM32F407VGT6`.
    pub(super) fn chip(&self, mcu: &str) -> Option<Chip> {
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

    /// The HAL's name of a unit.
    pub(super) fn peripheral<'a>(&'a self, unit: &'a str) -> &'a str {
        let wanted = numbered(unit);
        let own = |one: &&Peripheral| one.name == wanted && self.fits(&one.lines);
        self.peripherals.iter().find(own).map_or(unit, |one| one.hal.as_str())
    }

    /// The HAL's name of a DMA channel: `DMA1_CH0` of `1,0`. `None` if the HAL has no such channel by number, as for
    /// the basic controllers of H7.
    pub(super) fn channel(&self, stream: &str) -> Option<String> {
        let (controller, stream) = stream.split_once(',')?;
        let name = self.dma.replace("{controller}", controller).replace("{stream}", stream);
        self.interrupts.iter().any(|one| one.name == name).then_some(name)
    }

    /// The interrupt of a unit, a DMA channel or an external line.
    pub(super) fn interrupt(&self, unit: &str, signal: &str) -> Option<&str> {
        let wanted = numbered(unit);
        let own = |one: &&Interrupts| one.name == wanted && self.fits(&one.lines);
        let found = self.interrupts.iter().find(own)?;
        found.of.get(signal).map(String::as_str)
    }
}

/// The name of a unit in a profile. A unit without a number is the only one of its kind.
pub(super) fn numbered(unit: &str) -> &str {
    if unit == "CAN" { "CAN1" } else { unit }
}
