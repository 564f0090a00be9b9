//! Built-in boards: a name in, the board's table and facts out.
//!
//! The boards are the folders of `boards/`, embedded by the generated module `registry`. Names are
//! looked up without parsing any of them.

use std::collections::BTreeMap;

use sensedsl_diagnostics::nearest;
use serde::{Deserialize, Deserializer};

pub use crate::entry::Entry;
use crate::mcu;
use crate::pin::PinName;
use crate::profile::{Transport, pin, pins};
use crate::registry::{BOARDS, FILES};
use crate::table::{Table, load};

/// All built-in boards, in natural order of their names.
#[must_use]
pub fn all() -> &'static [Entry] {
    BOARDS
}

/// The board with a name or alias. Case, `-` and `_` do not matter.
#[must_use]
pub fn find(name: &str) -> Option<&'static Entry> {
    let wanted = fold(name);
    let called = |entry: &&Entry| names_of(entry).any(|name| fold(name) == wanted);
    BOARDS.iter().find(called)
}

/// The board name closest to a misspelt one.
#[must_use]
pub fn nearest_name(name: &str) -> Option<&'static str> {
    let folded: Vec<(String, &'static str)> =
        BOARDS.iter().flat_map(names_of).map(|name| (fold(name), name)).collect();
    let found = nearest(&fold(name), folded.iter().map(|(folded, _)| folded.as_str()))?;
    folded.iter().find(|(folded, _)| folded == found).map(|(_, name)| *name)
}

/// Boards and MCUs that people own and that are not built in yet: how their names begin, and what they are.
const NOT_YET: &[(&str, &str)] = &[
    ("esp8266", "ESP8266"),
    ("wemosd1", "ESP8266"),
    ("nodemcu", "ESP8266"),
    ("teensy3", "Teensy 3"),
    ("teensylc", "Teensy LC"),
    ("arduinogiga", "Arduino Giga"),
    ("arduinounor4wifi", "Arduino Uno R4 WiFi"),
    ("ra4m1", "RA4M1"),
];

/// What a name means that is of no built-in board, but of one that people own: `ESP32`.
#[must_use]
pub fn not_yet(name: &str) -> Option<&'static str> {
    let folded = fold(name);
    NOT_YET.iter().find(|(start, _)| folded.starts_with(start)).map(|(_, what)| *what)
}

/// A board with that MCU, preferably one that a system supports. If only a user's table states the
/// MCU, clocks and folders are taken from this board.
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
    /// The table as stored. It may leave the usages to the MCU.
    #[must_use]
    pub fn csv(&self) -> &'static str {
        self.file("pins.csv")
    }

    /// The pins as stored; if the table names no MCU, it is that of the board.
    #[must_use]
    pub fn table(&self) -> Table {
        let mut table = load(self.csv()).board;
        table.mcu.get_or_insert_with(|| self.mcu.to_owned());
        table
    }

    /// The facts besides the pins.
    ///
    /// # Errors
    ///
    /// Fails if the file is damaged; tests rule that out.
    pub fn board(&self) -> Result<Board, String> {
        Board::parse(self.file("board.toml"))
    }

    /// A file of its folder.
    fn file(&self, name: &str) -> &'static str {
        FILES.text(&format!("boards/{}/{name}", self.name))
    }
}

/// The facts of a board besides its pins: the file `board.toml`.
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
    /// A one-line description.
    pub description: String,
    /// The sources of the facts.
    pub source: Vec<Source>,
    /// The frequencies of the board's crystals.
    #[serde(default)]
    pub crystal: Crystal,
    /// What each system has for the board, by the system's name.
    #[serde(default)]
    pub system: BTreeMap<String, SystemFacts>,
    /// Links to a host; the first is the default.
    #[serde(default)]
    pub link: Vec<Link>,
    /// The user's button.
    pub button: Option<ActivePin>,
    /// An LED that the firmware may blink.
    pub led: Option<ActivePin>,
    /// What a person does so that the board takes a program, where it has no probe; a clause: `hold BOOTSEL while you
    /// plug the board in`.
    pub ready: Option<String>,
}

impl Board {
    /// What a system has for the board; if it has nothing, what another system has.
    #[must_use]
    pub fn facts_of(&self, system: Option<&str>) -> Option<&SystemFacts> {
        let own = system.and_then(|system| self.system.get(system));
        own.or_else(|| self.system.values().next())
    }
}

/// A source of facts.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Source {
    /// The facts from this source.
    pub what: String,
    /// The source.
    pub from: String,
    /// The licence.
    pub licence: String,
}

/// The frequencies of a board's crystals.
#[derive(Clone, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Crystal {
    /// Frequency of the main crystal, in hertz.
    pub hse_hz: Option<u32>,
    /// True if an external clock drives the input instead.
    #[serde(default)]
    pub hse_driven: bool,
    /// Frequency of the real-time clock's crystal, in hertz.
    pub lse_hz: Option<u32>,
}

/// What a system has for a board, besides its profile for the MCU.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
pub struct SystemFacts {
    /// The memory that the system's linker script gives to data, if known.
    pub ram_bytes: Option<u32>,
    /// The frequencies of the system's clock tree, by the system's name for each clock.
    #[serde(default)]
    pub clocks_hz: BTreeMap<String, u32>,
    /// Facts that only the system's generator reads.
    #[serde(flatten)]
    pub own: toml::Table,
}

/// A link to a host.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Link {
    /// The medium that carries the frames.
    pub transport: Transport,
    /// The peripheral instance: `OTG1`, `USART2`.
    pub unit: String,
    /// The pins that the link takes: minus, plus and others of a USB device; TX and RX of a serial
    /// port.
    #[serde(deserialize_with = "pins")]
    pub pins: Vec<PinName>,
    /// A remark.
    pub note: Option<String>,
}

/// A button or an LED.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ActivePin {
    /// The pin.
    #[serde(deserialize_with = "pin")]
    pub pin: PinName,
    /// True if a high level means pressed, or lit.
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
    /// Fails if the text lacks something that a board needs.
    pub fn parse(text: &str) -> Result<Self, String> {
        toml::from_str(text).map_err(|error| error.to_string())
    }
}
