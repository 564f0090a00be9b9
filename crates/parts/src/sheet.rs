//! The pins of a part, or of what several parts have in common, as a board table.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use sensedsl_board::pin::{PinName, natural};
use sensedsl_board::table::ROUTED;

use crate::listing::{Origin, Part};
use crate::shipped::data;

/// A usage and its alternate function.
pub type Usage = (String, Option<u8>);

/// The columns of usages, each with the prefixes of the usages in it; the last takes the rest.
const COLUMNS: [(&str, &[&str]); 10] = [
    ("ADC", &["ADC"]),
    ("DAC", &["DAC"]),
    ("I2C", &["I2C", "TWI", "LPI2C", "SERCOM"]),
    (
        "TIM",
        &[
            "TIM", "PWM", "OC0", "OC1", "OC2", "OC3", "OC4", "OC5", "ICP", "LEDC", "PCNT", "RMT",
            "QDEC", "PDEC", "TC", "FLEXPWM", "QTIMER", "ENC1_", "ENC2_", "ENC3_", "ENC4_",
        ],
    ),
    ("UART", &["USART", "UART", "LPUART"]),
    ("SPI", &["SPI", "LPSPI"]),
    ("I2S", &["I2S"]),
    ("CAN", &["CAN", "FDCAN", "TWAI", "FLEXCAN"]),
    ("USB", &["USB"]),
    ("Other", &[""]),
];

/// Pins with their usages.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Sheet {
    /// By pin in natural order.
    rows: BTreeMap<PinName, SheetRow>,
}

#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct SheetRow {
    position: Option<String>,
    usages: Vec<(String, Option<u8>)>,
}

impl Sheet {
    /// The pins of a part.
    #[must_use]
    pub fn of(part: Part) -> Self {
        let rows = match part.0 {
            Origin::Table(of) => of_table(part, of.die),
            Origin::Rule(chip) => {
                let pins = (0..chip.pins).filter_map(|pin| {
                    let name = PinName::parse(&format!("GP{pin}"))?;
                    Some((name, SheetRow { position: None, usages: chip.usages(pin) }))
                });
                pins.collect()
            }
        };
        Self { rows }
    }

    /// The pins and usages that all sheets have, with positions where they agree.
    #[must_use]
    pub fn common(sheets: &[Self]) -> Self {
        let mut sheets = sheets.iter();
        let mut common = sheets.next().cloned().unwrap_or(Self { rows: BTreeMap::new() });
        for sheet in sheets {
            common.rows.retain(|name, row| {
                let Some(other) = sheet.rows.get(name) else { return false };
                if row.position != other.position {
                    row.position = None;
                }
                row.usages.retain(|usage| other.usages.contains(usage));
                true
            });
        }
        common
    }

    /// Each pin with its position and usages.
    pub fn pins(&self) -> impl Iterator<Item = (&PinName, Option<&str>, &[Usage])> {
        let rows = self.rows.iter();
        rows.map(|(name, row)| (name, row.position.as_deref(), row.usages.as_slice()))
    }

    /// The position and the usages of a pin.
    #[must_use]
    pub fn pin(&self, name: &PinName) -> Option<(Option<&str>, &[Usage])> {
        let row = self.rows.get(name)?;
        Some((row.position.as_deref(), row.usages.as_slice()))
    }

    /// Whether several pins are on one contact of the package.
    #[must_use]
    pub fn shares(&self) -> bool {
        !self.shared().is_empty()
    }

    /// The contacts of the package that several pins are on.
    #[must_use]
    pub fn shared(&self) -> Vec<&str> {
        let mut places: Vec<&str> =
            self.rows.values().filter_map(|row| row.position.as_deref()).collect();
        places.sort_unstable();
        let twice = places.windows(2).filter(|pair| pair.first() == pair.last());
        let mut shared: Vec<&str> = twice.filter_map(|pair| pair.first().copied()).collect();
        shared.dedup();
        shared
    }

    /// Everything that a wiring can depend on: the pins, their usages, and which pins share a
    /// place. Sheets with the same key have the same wirings.
    #[must_use]
    pub fn key(&self) -> String {
        let mut places: BTreeMap<&str, usize> = BTreeMap::new();
        let mut key = String::new();
        for (index, (name, row)) in self.rows.iter().enumerate() {
            let place = row.position.as_deref().map(|place| *places.entry(place).or_insert(index));
            // Writing to a String cannot fail.
            let _ = write!(key, "{name}@{}", place.unwrap_or(index));
            for (signal, alternate) in &row.usages {
                let _ = write!(key, " {signal}/{}", alternate.map_or(-1, i16::from));
            }
            key.push('\n');
        }
        key
    }

    /// The board table as text.
    #[must_use]
    pub fn csv(&self, mcu: &str, package: Option<&str>) -> String {
        let mut csv = format!("# mcu = {mcu}\n");
        if let Some(package) = package {
            let _ = writeln!(csv, "# package = {package}");
        }
        csv.push_str("Pin,Position");
        for (column, _) in COLUMNS {
            let _ = write!(csv, ",{column}");
        }
        csv.push('\n');
        for (name, row) in &self.rows {
            let _ = write!(csv, "{name},{}", row.position.as_deref().unwrap_or_default());
            for (column, _) in COLUMNS {
                csv.push(',');
                let mut empty = true;
                for (signal, alternate) in row.usages.iter().filter(|(s, _)| column_of(s) == column)
                {
                    csv.push_str(if empty { "" } else { " " });
                    csv.push_str(signal);
                    if let Some(alternate) = alternate {
                        let _ = write!(csv, "@{alternate}");
                    }
                    empty = false;
                }
            }
            csv.push('\n');
        }
        csv
    }
}

/// The names of the columns of usages, in order.
pub(crate) fn columns() -> impl Iterator<Item = &'static str> {
    COLUMNS.iter().map(|(column, _)| *column)
}

pub(crate) fn column_of(signal: &str) -> &'static str {
    let signal = signal.trim_start_matches(ROUTED);
    let fits = |starts: &[&str]| starts.iter().any(|start| signal.starts_with(start));
    COLUMNS.iter().find(|(_, starts)| fits(starts)).map_or("Other", |(column, _)| column)
}

fn of_table(part: Part, die: usize) -> BTreeMap<PinName, SheetRow> {
    let data = data();
    let name = |pin: usize| PinName::parse(data.pins.get(pin)?);
    let rows = data.dies.get(die).map(Vec::as_slice).unwrap_or_default();
    let rows = rows.iter().filter_map(|row| data.rows.get(*row));
    let usages = |row: &crate::format::Row| {
        let named = row.usages.iter().filter_map(|(signal, alternate)| {
            Some((data.signals.get(*signal)?.clone(), *alternate))
        });
        let mut usages: Vec<(String, Option<u8>)> = named.collect();
        usages.sort_by(|(a, _), (b, _)| natural(a, b));
        usages
    };
    let on_die: BTreeMap<usize, Vec<(String, Option<u8>)>> =
        rows.map(|row| (row.pin, usages(row))).collect();
    let Some(layout) = part.layout() else {
        let rows = on_die.into_iter();
        return rows
            .filter_map(|(pin, usages)| Some((name(pin)?, SheetRow { position: None, usages })))
            .collect();
    };
    let mut found = BTreeMap::new();
    for (position, pin) in &layout.places {
        let Some(name) = name(*pin) else { continue };
        let position = data.positions.get(*position).cloned();
        let usages = on_die.get(pin).cloned().unwrap_or_default();
        // A pin with two contacts is one pin; the first stands for both.
        found.entry(name).or_insert(SheetRow { position, usages });
    }
    found
}
