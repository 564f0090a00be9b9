//! What is kept by hand: `facts.toml`.

use std::collections::BTreeMap;

use anyhow::Result;
use serde::Deserialize;

/// The file.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Facts {
    pub(crate) target: String,
    /// How the names of parts begin that have no profile.
    pub(crate) without: Vec<String>,
    pub(crate) kernel: Vec<String>,
    pub(crate) blocks: BTreeMap<String, Block>,
    pub(crate) family: BTreeMap<String, Family>,
    pub(crate) clock: Vec<Clock>,
}

/// What timers of a block can do.
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

/// What the HAL makes of a family.
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
    /// What the clock of the CAN controllers is called, where it is not the one that their metadata names.
    pub(crate) can: Option<String>,
}

/// How the converters of a family are clocked.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Converter {
    pub(crate) clock: String,
    pub(crate) divider: u32,
    pub(crate) cycles: u32,
}

/// What the firmware makes of the clocks of some parts.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Clock {
    pub(crate) parts: Vec<String>,
    /// Members of the HAL's clocks and their values.
    #[serde(default)]
    pub(crate) set: Vec<String>,
    /// What can drive them, best first.
    pub(crate) ways: Vec<toml::Table>,
    pub(crate) hz: BTreeMap<String, u32>,
}

impl Facts {
    pub(crate) fn read() -> Result<Self> {
        Ok(toml::from_str(include_str!("facts.toml"))?)
    }

    /// The clocks that the firmware makes of a part.
    pub(crate) fn clock(&self, name: &str) -> Option<&Clock> {
        let longest = |clock: &&Clock| {
            let own = clock.parts.iter().filter(|part| name.starts_with(part.as_str()));
            own.map(String::len).max()
        };
        let fits = self.clock.iter().filter(|clock| longest(clock).is_some());
        fits.max_by_key(|clock| longest(clock))
    }
}
