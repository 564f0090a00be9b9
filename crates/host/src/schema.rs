//! `schema.json`: what the links of a design's boards carry, for programs that were not generated for it.

use std::fmt;

use sensedsl_wire::{Checksum, Direction, Item, ScalarType, Schema, ValueType};
use serde::Deserialize;

use crate::scale::Scale;

/// The versions of the format that are read. The first one had neither stamps nor curves.
const VERSIONS: [u64; 2] = [1, 2];

/// A board's link, and how its values are shown.
#[derive(Clone, Debug, PartialEq)]
pub struct Board {
    /// The board's name.
    pub name: String,
    /// The link on the wire.
    pub schema: Schema,
    /// The baud rate of a serial link; none over USB, or where the file does not say.
    pub baud: Option<u32>,
    /// After how long without a frame from the host actuators take their failsafe.
    pub silence_ms: Option<u32>,
    /// The devices, in the order of the schema.
    pub devices: Vec<Device>,
}

/// A sensor or actuator.
#[derive(Clone, Debug, PartialEq)]
pub struct Device {
    /// Its name.
    pub name: String,
    /// Its identifier.
    pub id: u8,
    /// Where its value travels.
    pub direction: Direction,
    /// The type of its value.
    pub value: ValueType,
    /// What it is connected to: `analog`, `i2c`, …; empty where the file does not say.
    pub kind: String,
    /// The unit of what is shown.
    pub quantity: Option<String>,
    /// From raw numbers to shown ones.
    pub scale: Scale,
    /// The least shown number.
    pub min: Option<f64>,
    /// The greatest shown number.
    pub max: Option<f64>,
    /// From one value to the next; none for values that come when something happens, or where the file does not say.
    pub cycle_ms: Option<u32>,
    /// The controller on the board whose code sets it, if it does not obey the host.
    pub obeys: Option<String>,
}

/// Why a text is not a `schema.json` that can be used.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum SchemaError {
    /// It is not JSON, or lacks a field: the reason, with its line.
    Form(String),
    /// It has a version that is not read here; none for a text without one.
    Version(Option<u64>),
    /// A board's items do not give its hash: the file was changed by hand, or is of a newer generator.
    Hash {
        /// The board.
        board: String,
        /// The hash of its items.
        computed: u32,
        /// The hash in the file.
        written: String,
    },
}

impl fmt::Display for SchemaError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Form(why) => write!(f, "it is no schema: {why}"),
            Self::Version(Some(version)) => {
                write!(f, "it has version {version}, and this program reads 1 and 2")
            }
            Self::Version(None) => f.write_str("it has no `version`"),
            Self::Hash { board, computed, written } => write!(
                f,
                "the items of `{board}` have the hash 0x{computed:08x}, and it says {written}: it was changed after it \
                 was generated"
            ),
        }
    }
}

impl std::error::Error for SchemaError {}

/// The version alone: what the rest means depends on it.
#[derive(Deserialize)]
struct Versioned {
    version: Option<u64>,
}

#[derive(Deserialize)]
struct File {
    boards: Vec<BoardEntry>,
}

#[derive(Deserialize)]
struct BoardEntry {
    name: String,
    hash: String,
    checksum: String,
    #[serde(default)]
    stamp: bool,
    #[serde(default)]
    baud: Option<u32>,
    #[serde(default)]
    silence_ms: Option<u32>,
    items: Vec<ItemEntry>,
}

#[derive(Deserialize)]
struct ItemEntry {
    id: u8,
    name: String,
    direction: String,
    #[serde(rename = "type")]
    scalar: String,
    #[serde(default)]
    length: Option<u16>,
    #[serde(default)]
    kind: String,
    #[serde(default)]
    quantity: Option<String>,
    #[serde(default)]
    scale: Option<f64>,
    #[serde(default)]
    offset: Option<f64>,
    #[serde(default)]
    curve: Vec<(f64, f64)>,
    #[serde(default)]
    min: Option<f64>,
    #[serde(default)]
    max: Option<f64>,
    #[serde(default)]
    cycle_ms: Option<u32>,
    #[serde(default)]
    owner: Option<OwnerEntry>,
}

#[derive(Deserialize)]
struct OwnerEntry {
    controller: String,
    host: String,
}

impl Board {
    /// All boards of a `schema.json`, in its order.
    ///
    /// # Errors
    /// Fails if the text is not one, has an unknown version, or does not give the hashes that it names.
    pub fn all_of_json(text: &str) -> Result<Vec<Self>, SchemaError> {
        let form = |error: serde_json::Error| SchemaError::Form(error.to_string());
        let Versioned { version } = serde_json::from_str(text).map_err(form)?;
        if version.is_none_or(|version| !VERSIONS.contains(&version)) {
            return Err(SchemaError::Version(version));
        }
        let file: File = serde_json::from_str(text).map_err(form)?;
        file.boards.into_iter().map(Self::read).collect()
    }

    fn read(entry: BoardEntry) -> Result<Self, SchemaError> {
        let checksum = [Checksum::None, Checksum::Crc16, Checksum::Crc32];
        let checksum = checksum.into_iter().find(|one| one.name() == entry.checksum);
        if !is_name(&entry.name) {
            return Err(SchemaError::Form(format!("{:?} is no name of a board", entry.name)));
        }
        let Some(checksum) = checksum else {
            return Err(SchemaError::Form(format!("`{}` is no checksum", entry.checksum)));
        };
        let devices: Vec<Device> =
            entry.items.into_iter().map(Device::read).collect::<Result<_, _>>()?;
        let items = devices.iter().map(|device| Item {
            id: device.id,
            name: device.name.clone(),
            direction: device.direction,
            value: device.value,
        });
        let schema = Schema { checksum, stamp: entry.stamp, items: items.collect() };
        let computed = schema.hash();
        if entry.hash != format!("0x{computed:08x}") {
            return Err(SchemaError::Hash { board: entry.name, computed, written: entry.hash });
        }
        let (baud, silence_ms) = (entry.baud, entry.silence_ms);
        Ok(Self { name: entry.name, schema, baud, silence_ms, devices })
    }

    /// The place of the device with that identifier, among those that travel in a direction.
    #[must_use]
    pub fn device(&self, direction: Direction, id: u8) -> Option<usize> {
        self.devices.iter().position(|one| one.id == id && one.direction == direction)
    }
}

impl Device {
    fn read(entry: ItemEntry) -> Result<Self, SchemaError> {
        let form = |what: String| Err(SchemaError::Form(what));
        let both = [Direction::Sensor, Direction::Actuator];
        let Some(direction) = both.into_iter().find(|one| one.name() == entry.direction) else {
            return form(format!("`{}` is no direction", entry.direction));
        };
        let Some(scalar) = ScalarType::from_name(&entry.scalar) else {
            return form(format!("`{}` is no type", entry.scalar));
        };
        if entry.length == Some(0) {
            return form(format!("`{}` is an array without elements", entry.name));
        }
        if !is_name(&entry.name) {
            return form(format!("{:?} is no name of a device", entry.name));
        }
        if let Some(unit) = entry.quantity.as_ref().filter(|unit| !is_shown(unit)) {
            return form(format!("the unit {unit:?} has characters that are not shown"));
        }
        if matches!(entry.id, 0 | 255) {
            return form(format!("`{}` has the identifier {} of the link", entry.name, entry.id));
        }
        Ok(Self {
            name: entry.name,
            id: entry.id,
            direction,
            value: ValueType { scalar, length: entry.length },
            kind: entry.kind,
            quantity: entry.quantity,
            scale: Scale::new(entry.scale, entry.offset, entry.curve),
            min: entry.min,
            max: entry.max,
            cycle_ms: entry.cycle_ms,
            obeys: entry.owner.filter(|own| own.host == "refused").map(|own| own.controller),
        })
    }
}

/// Whether a text is a name of the language: a stranger's file must not write to the terminal.
fn is_name(text: &str) -> bool {
    !text.is_empty() && text.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
}

/// Whether all characters of a text are seen where they stand.
fn is_shown(text: &str) -> bool {
    !text.chars().any(|c| {
        c.is_control()
            || matches!(c, '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}' | '\u{feff}')
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const ONE: &str = r#"{ "version": 2, "boards": [ { "name": "A", "hash": "HASH", "checksum": "none", "items": [
        { "id": 1, "name": "Pair", "direction": "sensor", "type": "int16", "length": 2, "new": true } ] } ] }"#;

    #[test]
    fn what_is_wrong_is_said() {
        let read = |text: &str| Board::all_of_json(text).map_err(|error| error.to_string());
        let text = ONE.replace("HASH", "0x5f1cdbe1");
        let error = read(&ONE.replace("HASH", "0x00000000")).unwrap_err();
        let hash = error.split(' ').find(|word| word.starts_with("0x")).unwrap();
        let text = text.replace("0x5f1cdbe1", hash.trim_end_matches(','));
        let boards = read(&text).unwrap();
        assert_eq!(boards[0].devices[0].value.to_string(), "int16[2]");
        assert!(error.contains("changed after"), "{error}");
        for (from, to, expected) in [
            ("\"version\": 2", "\"version\": 3", "it has version 3"),
            ("\"version\": 2,", "", "it has no `version`"),
            ("int16", "int17", "`int17` is no type"),
            ("\"none\"", "\"crc8\"", "`crc8` is no checksum"),
            ("sensor", "sensory", "`sensory` is no direction"),
            ("\"length\": 2", "\"length\": 0", "without elements"),
            ("\"id\": 1", "\"id\": 255", "identifier 255"),
            ("\"id\": 1,", "", "missing field `id`"),
            ("\"Pair\"", "\"Pa\\u001bir\"", "is no name of a device"),
            ("\"new\": true", "\"quantity\": \"a\\u202eb\"", "characters that are not shown"),
            ("\"A\"", "\"\"", "is no name of a board"),
            ("{", "", "it is no schema"),
        ] {
            let error = read(&text.replacen(from, to, 1)).unwrap_err();
            assert!(error.contains(expected), "{to}: {error}");
        }
    }
}
