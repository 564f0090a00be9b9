//! The dump of a flight controller's resources: `resource MOTOR 1 A08`, `timer A08 AF1`,
//! `set gyro_1_spibus = 1`.

use sensedsl_diagnostics::{FileId, Span};

use super::{Board, OnTimer, Resource};
use crate::log::Log;
use crate::project::Addressed;
use crate::project::pads::{lines, pad};

/// What settings of buses end with.
const BUS_ENDINGS: [&str; 3] = ["_spibus", "_spi_bus", "_spi_device"];

/// Whether a text is a dump.
pub(super) fn is_dump(text: &str) -> bool {
    text.lines().any(|line| {
        let words: Vec<&str> = line.split_whitespace().take(4).collect();
        matches!(words.as_slice(), ["resource", _, _, pin] if *pin == "NONE" || pad(pin).is_some())
    })
}

/// Reads a dump.
pub(super) fn read(file: FileId, text: &str, log: &mut Log) -> Board {
    let mut board = Board::default();
    let mut settings = Vec::new();
    for (line, start) in lines(text) {
        let span = Span::new(file, start..start + line.len());
        let words: Vec<&str> = line.split_whitespace().take(6).collect();
        match words.as_slice() {
            ["resource", _, _, "NONE", ..] => {}
            ["resource", what, index, pin, ..] => match pad(pin) {
                Some(pin) => board.resources.push(Resource {
                    what: (*what).to_ascii_uppercase(),
                    index: (*index).to_owned(),
                    pin,
                    span,
                }),
                None => log.dropped(span, "", &format!("`{pin}` is not a pin")),
            },
            ["timer", pin, alternate, ..] => {
                let number = alternate.strip_prefix("AF").and_then(|digits| digits.parse().ok());
                if let (Some(pin), Some(number)) = (pad(pin), number) {
                    board.timers.insert(pin, OnTimer::Alternate(number));
                }
            }
            ["board_name", name, ..] => board.name = Some((*name).to_owned()),
            ["#", "Betaflight", "/", mcu, ..] if mcu.starts_with("STM32") => {
                board.mcu = Some(((*mcu).to_owned(), span));
            }
            ["set", key, "=", value, ..] => settings.push((*key, *value, span)),
            _ => {}
        }
    }
    for (key, value, _) in &settings {
        let part = BUS_ENDINGS.iter().find_map(|ending| key.strip_suffix(ending));
        if let Some(part) = part.filter(|_| value.parse::<u8>().is_ok_and(|number| number > 0)) {
            board.buses.insert(part.to_owned(), format!("SPI{value}"));
        }
    }
    let setting = |key: String| {
        let (_, value, span) = settings.iter().find(|(name, _, _)| *name == key)?;
        Some((value.parse::<u8>().ok().filter(|value| (1..0x80).contains(value))?, *span))
    };
    for part in ["baro", "mag"] {
        let bus = setting(format!("{part}_i2c_device"));
        let address = setting(format!("{part}_i2c_address"));
        if let (Some((bus, _)), Some((address, span))) = (bus, address) {
            let unit = format!("I2C{bus}");
            board.addressed.push(Addressed { name: part.to_owned(), unit, address, span });
        }
    }
    board
}
