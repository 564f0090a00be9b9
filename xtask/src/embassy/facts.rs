//! The facts that are kept by hand: `facts.toml`.

use std::collections::BTreeMap;

use anyhow::Result;
use serde::Deserialize;

/// The contents of the file.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Facts {
    pub(crate) target: String,
    /// The prefixes of the names of parts that have no profile.
    pub(crate) without: Vec<String>,
    pub(crate) kernel: Vec<String>,
    pub(crate) blocks: BTreeMap<String, Block>,
    pub(crate) family: BTreeMap<String, Family>,
    pub(crate) clock: Vec<Clock>,
}

/// The abilities of the timers of a block.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Block {
    pub(crate) bits: u8,
    pub(crate) channels: u8,
    #[serde(default)]
    pub(crate) complementary: u8,
    #[serde(default)]
    pub(crate) encoder: bool,
}

/// The names and values that the HAL uses for a family.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Family {
    pub(crate) adc: String,
    pub(crate) new: String,
    pub(crate) read: String,
    pub(crate) sampling: toml::Value,
    pub(crate) target: String,
    pub(crate) hz: u32,
    /// The register with the cause of the last reset.
    pub(crate) reset: Option<String>,
    #[serde(default)]
    pub(crate) excludes: Vec<String>,
    pub(crate) converter: Option<Converter>,
    /// The name of the CAN controllers' clock, if it is not the one in their metadata.
    pub(crate) can: Option<String>,
}

/// The clocks of a family's converters.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Converter {
    pub(crate) clock: String,
    pub(crate) divider: u32,
    pub(crate) cycles: u32,
}

/// The clocks that the firmware sets up for some parts.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Clock {
    pub(crate) parts: Vec<String>,
    /// Fields of the HAL's clock configuration and their values.
    #[serde(default)]
    pub(crate) set: Vec<String>,
    /// The possible sources of the clocks, the best one first.
    pub(crate) ways: Vec<toml::Table>,
    pub(crate) hz: BTreeMap<String, u32>,
}

impl Facts {
    pub(crate) fn read() -> Result<Self> {
        Ok(toml::from_str(include_str!("facts.toml"))?)
    }

    /// The clocks that the firmware sets up for a part.
    pub(crate) fn clock(&self, name: &str) -> Option<&Clock> {
        let longest = |clock: &&Clock| {
            let own = clock.parts.iter().filter(|part| name.starts_with(part.as_str()));
            own.map(String::len).max()
        };
        let fits = self.clock.iter().filter(|clock| longest(clock).is_some());
        fits.max_by_key(|clock| longest(clock))
    }
}
