//! Built-in boards: a name in, the board's table and facts out.
//!
//! The boards are the folders of `boards/`, embedded by the generated module `registry`. Names are
//! looked up without reading any of them.

use std::collections::BTreeMap;

use sensedsl_diagnostics::nearest;
use serde::{Deserialize, Deserializer};

use crate::mcu;
use crate::pin::PinName;
use crate::profile::{Transport, pin, pins};
use crate::registry::BOARDS;
use crate::table::{Table, load};

/// What the registry knows of a board.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Entry {
    /// The name.
    pub name: &'static str,
    /// Other names.
    pub aliases: &'static [&'static str],
    /// The part number of the MCU.
    pub mcu: &'static str,
    /// One line on what it is.
    pub description: &'static str,
    /// The text of `board.toml`.
    facts: &'static str,
    /// The text of `pins.csv`.
    pins: &'static str,
}

/// All built-in boards, in natural order of their names.
#[must_use]
pub fn all() -> &'static [Entry] {
    BOARDS
}

/// The board of a name or alias. Case, `-` and `_` do not matter.
#[must_use]
pub fn find(name: &str) -> Option<&'static Entry> {
    let wanted = fold(name);
    let called = |entry: &&Entry| names_of(entry).any(|name| fold(name) == wanted);
    BOARDS.iter().find(called)
}

/// The board name that a misspelt one is near to.
#[must_use]
pub fn nearest_name(name: &str) -> Option<&'static str> {
    let folded: Vec<(String, &'static str)> =
        BOARDS.iter().flat_map(names_of).map(|name| (fold(name), name)).collect();
    let found = nearest(&fold(name), folded.iter().map(|(folded, _)| folded.as_str()))?;
    folded.iter().find(|(folded, _)| folded == found).map(|(_, name)| *name)
}

/// A board with that MCU, rather one that the system can be built for: where a table of the user
/// alone says which MCU it is, its clocks and folders are taken from there.
#[must_use]
pub fn of_mcu(name: &str) -> Option<&'static Entry> {
    let alike = || BOARDS.iter().filter(|entry| mcu::same_part(entry.mcu, name));
    let built = |entry: &&Entry| entry.board().is_ok_and(|board| !board.system.is_empty());
    alike().find(built).or_else(|| alike().next())
}

/// The part numbers of all built-in boards.
pub fn mcus() -> impl Iterator<Item = &'static str> {
    BOARDS.iter().map(|entry| entry.mcu)
}

fn names_of(entry: &Entry) -> impl Iterator<Item = &'static str> + use<> {
    std::iter::once(entry.name).chain(entry.aliases.iter().copied())
}

/// A name without case, `-` and `_`.
fn fold(name: &str) -> String {
    name.chars().filter(|c| !matches!(c, '-' | '_')).flat_map(char::to_lowercase).collect()
}

impl Entry {
    pub(crate) const fn new(
        names: (&'static str, &'static [&'static str]),
        mcu: &'static str,
        description: &'static str,
        (facts, pins): (&'static str, &'static str),
    ) -> Self {
        let (name, aliases) = names;
        Self { name, aliases, mcu, description, facts, pins }
    }

    /// The table as it is stored. It may leave the usages to the MCU.
    #[must_use]
    pub fn csv(&self) -> &'static str {
        self.pins
    }

    /// The pins as they are stored; the MCU is that of the board where the table names none.
    #[must_use]
    pub fn table(&self) -> Table {
        let mut table = load(self.pins).board;
        table.mcu.get_or_insert_with(|| self.mcu.to_owned());
        table
    }

    /// The facts beside the pins.
    ///
    /// # Errors
    ///
    /// When the file is damaged; tests rule that out.
    pub fn board(&self) -> Result<Board, String> {
        Board::parse(self.facts)
    }
}

/// A board beside its pins: the file `board.toml`.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Board {
    /// The name.
    pub name: String,
    /// Other names.
    #[serde(default)]
    pub aliases: Vec<String>,
    /// The part number of the MCU.
    pub mcu: String,
    /// One line on what it is.
    pub description: String,
    /// Where the facts come from.
    pub source: Vec<Source>,
    /// Crystals.
    #[serde(default)]
    pub crystal: Crystal,
    /// What systems have for the board, by their names.
    #[serde(default)]
    pub system: BTreeMap<String, SystemFacts>,
    /// Links to a host; the first is the default one.
    #[serde(default)]
    pub link: Vec<Link>,
    /// The user's button.
    pub button: Option<ActivePin>,
    /// A light that the firmware may blink.
    pub led: Option<ActivePin>,
}

impl Board {
    /// What a system has for the board; where it has nothing, what any other one has.
    #[must_use]
    pub fn facts_of(&self, system: Option<&str>) -> Option<&SystemFacts> {
        let own = system.and_then(|system| self.system.get(system));
        own.or_else(|| self.system.values().next())
    }
}

/// Where facts come from.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Source {
    /// Which facts.
    pub what: String,
    /// From where.
    pub from: String,
    /// Under which licence.
    pub licence: String,
}

/// Crystals.
#[derive(Clone, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Crystal {
    /// The main one.
    pub hse_hz: Option<u32>,
    /// A clock drives the input in its place.
    #[serde(default)]
    pub hse_driven: bool,
    /// The one of the clock.
    pub lse_hz: Option<u32>,
}

/// What a system has for a board beside its profile of the MCU.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
pub struct SystemFacts {
    /// The memory that its linker script gives to data, where it is known.
    pub ram_bytes: Option<u32>,
    /// What its clock tree gives, by the system's name of the clock.
    #[serde(default)]
    pub clocks_hz: BTreeMap<String, u32>,
    /// What only its generator reads.
    #[serde(flatten)]
    pub own: toml::Table,
}

/// A link to a host.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Link {
    /// What carries the frames.
    pub transport: Transport,
    /// The peripheral instance: `OTG1`, `USART2`.
    pub unit: String,
    /// The pins that the link takes: minus, plus and more of a USB device, TX and RX of a serial
    /// port.
    #[serde(deserialize_with = "pins")]
    pub pins: Vec<PinName>,
    /// A remark.
    pub note: Option<String>,
}

/// A button or a light.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ActivePin {
    /// Its pin.
    #[serde(deserialize_with = "pin")]
    pub pin: PinName,
    /// The level that means pressed, or lit.
    #[serde(rename = "active", deserialize_with = "level")]
    pub active_high: bool,
}

fn level<'de, D: Deserializer<'de>>(deserializer: D) -> Result<bool, D::Error> {
    match String::deserialize(deserializer)?.as_str() {
        "high" => Ok(true),
        "low" => Ok(false),
        other => Err(serde::de::Error::custom(format!("`{other}` is neither high nor low"))),
    }
}

impl Board {
    /// Reads a `board.toml`.
    ///
    /// # Errors
    ///
    /// When the text does not say what a board needs.
    pub fn parse(text: &str) -> Result<Self, String> {
        toml::from_str(text).map_err(|error| error.to_string())
    }
}
