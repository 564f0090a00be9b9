//! Pins in, with their usages in any order; a board table out, with the usages in the columns of
//! their peripherals and the inputs of several converters merged.

use std::collections::{BTreeMap, BTreeSet};

use sensedsl_board::pin::{PinName, natural};
use sensedsl_board::place::Place;
use sensedsl_board::remap::Blocks;
use sensedsl_board::signal::{Function, Signal};
use sensedsl_board::table::{Column, Pin, Property, ROUTED, Role, Table, Usage};
use sensedsl_diagnostics::Span;
use sensedsl_limits::{PIN_USAGES_MAX, PINS_MAX};

use crate::log::Log;

/// A future row of a table.
#[derive(Clone, Debug)]
pub(crate) struct Row {
    /// The pin, without its usages.
    pub(crate) pin: Pin,
    /// Signals and their alternate functions.
    pub(crate) usages: Vec<(String, Option<u8>)>,
}

impl Row {
    pub(crate) fn new(name: PinName) -> Self {
        let spelled = name.to_string();
        Self { pin: Pin::new(name, spelled), usages: Vec::new() }
    }
}

/// The columns of usages, each with the prefixes of its peripherals; the last column takes all
/// others.
const COLUMNS: [(&str, &[&str]); 10] = [
    ("ADC", &["ADC"]),
    ("DAC", &["DAC"]),
    ("I2C", &["I2C", "FMPI2C", "TWI"]),
    ("TIM", &["TIM", "LPTIM", "HRTIM"]),
    ("UART", &["USART", "UART", "LPUART"]),
    ("SPI", &["SPI"]),
    ("I2S", &["I2S"]),
    ("CAN", &["CAN", "FDCAN"]),
    ("USB", &["USB"]),
    ("Other", &[]),
];

/// The column of a signal.
fn column(signal: &Signal) -> &'static str {
    if matches!(signal.function(), Function::Timer { .. }) {
        return "TIM";
    }
    let unit = signal.name().split('_').next().unwrap_or_default();
    let stem = unit.trim_end_matches(|c: char| c.is_ascii_digit());
    let of = COLUMNS.iter().find(|(_, stems)| stems.contains(&stem));
    of.map_or("Other", |(column, _)| column)
}

/// Makes a table. Sorts the rows, and merges the usages of two rows for the same pin. Returns none,
/// and reports an error, if there is more than a table may have.
pub(crate) fn table(
    properties: &[(&str, String)],
    rows: Vec<Row>,
    whole: Span,
    log: &mut Log,
) -> Option<Table> {
    let mut pins: BTreeMap<PinName, Pin> = BTreeMap::new();
    let mut known: BTreeSet<(PinName, String)> = BTreeSet::new();
    for row in rows {
        let (name, mut usages) = (row.pin.name.clone(), usages(row.usages));
        usages.retain(|usage| known.insert((name.clone(), usage.signal.name().to_owned())));
        if let Some(pin) = pins.get_mut(&name) {
            pin.usages.extend(usages);
            if pin.usages.len() > PIN_USAGES_MAX {
                log.table_too_large(whole, "usages of one pin", PIN_USAGES_MAX);
                return None;
            }
            continue;
        }
        let pin = Pin { usages, ..row.pin };
        let (what, most) = match (pin.usages.len() > PIN_USAGES_MAX, pins.len() == PINS_MAX) {
            (true, _) => ("usages of one pin", PIN_USAGES_MAX),
            (_, true) => ("pins", PINS_MAX),
            _ => {
                pins.insert(name, pin);
                continue;
            }
        };
        log.table_too_large(whole, what, most);
        return None;
    }
    let pins: Vec<Pin> = pins.into_values().collect();
    let properties: Vec<Property> = properties
        .iter()
        .map(|(key, value)| Property { key: (*key).into(), value: value.clone(), range: 0..0 })
        .collect();
    let mcu = properties.iter().find(|one| one.key == "mcu").map(|one| one.value.clone());
    Some(Table { mcu, columns: columns(&pins), properties, pins, contacts: Vec::new() })
}

/// The columns that are not empty.
fn columns(pins: &[Pin]) -> Vec<Column> {
    let mut columns = vec![("Pin", Role::Pin)];
    let mut described = |header: &'static str, role, has: &dyn Fn(&Pin) -> bool| {
        columns.extend(pins.iter().any(has).then_some((header, role)));
    };
    let place = |pin: &Pin, has: &dyn Fn(&Place) -> bool| pin.places.iter().any(has);
    described("Position", Role::Position, &|pin| place(pin, &|place| place.position.is_some()));
    described("Side", Role::Side, &|pin| !pin.sides().is_empty());
    described("Header", Role::Header, &|pin| !pin.headers().is_empty());
    described("Label", Role::Label, &|pin| pin.label.is_some());
    described("Voltage", Role::Voltage, &|pin| pin.voltage.is_some());
    described("Onboard", Role::Onboard, &|pin| pin.onboard.is_some());
    let used = |header: &str| {
        let mut usages = pins.iter().flat_map(|pin| &pin.usages);
        usages.any(|usage| usage.column == header)
    };
    let of_usages = COLUMNS.iter().filter(|(header, _)| used(header));
    columns.extend(of_usages.map(|(header, _)| (*header, Role::Usages)));
    if pins.iter().any(|pin| pin.note.is_some()) {
        columns.push(("Note", Role::Note));
    }
    let column = |(header, role): (&str, Role)| Column { header: header.into(), role, range: 0..0 };
    columns.into_iter().map(column).collect()
}

/// The usages of a row in natural order, each signal once.
fn usages(list: Vec<(String, Option<u8>)>) -> Vec<Usage> {
    let mut converters: BTreeMap<u8, Vec<u8>> = BTreeMap::new();
    let mut usages: Vec<Usage> = Vec::new();
    let mut known: BTreeMap<String, usize> = BTreeMap::new();
    for (spelled, alternate) in list {
        let own = spelled.strip_prefix(ROUTED);
        let is_routed = own.is_some();
        let (spelled, blocks) = Blocks::split(own.unwrap_or(&spelled));
        let (signal, _) = Signal::parse(spelled);
        if let Function::Adc { units, channel } = signal.function() {
            converters.entry(*channel).or_default().extend(units);
        } else if let Some(same) = known.get(signal.name()).and_then(|at| usages.get_mut(*at)) {
            same.alternate = same.alternate.or(alternate);
        } else {
            known.insert(signal.name().to_owned(), usages.len());
            usages.push(Usage {
                blocks,
                is_routed,
                ..usage(signal, spelled.to_owned(), alternate)
            });
        }
    }
    for (channel, mut units) in converters {
        units.sort_unstable();
        units.dedup();
        let units: String = units.iter().map(u8::to_string).collect();
        let spelled = format!("ADC{units}_IN{channel}");
        usages.push(usage(Signal::parse(&spelled).0, spelled, None));
    }
    usages.sort_by(|a, b| natural(a.signal.name(), b.signal.name()));
    usages
}

fn usage(signal: Signal, spelled: String, alternate: Option<u8>) -> Usage {
    let column = column(&signal).into();
    Usage { column, signal, spelled, alternate, blocks: None, is_routed: false, range: 0..0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn converters_merge_and_columns_hold_their_peripherals() {
        let mut row = Row::new(PinName::parse("PA10").unwrap());
        for (signal, alternate) in [
            ("ADC3_IN1", None),
            ("TIM2_CH2", Some(1)),
            ("ADC1_IN1", None),
            ("ADC2_INP4", None),
            ("TIM2_CH2", None),
            ("ETH_REF_CLK", Some(11)),
        ] {
            row.usages.push((signal.into(), alternate));
        }
        let rows = vec![row, Row::new(PinName::parse("PA2").unwrap())];
        let mut log = Log::default();
        let whole = Span::new(log.sources.add("pins.csv", ""), 0..0);
        let mcu = [("mcu", "STM32F407VGTx".into())];
        let csv = table(&mcu, rows, whole, &mut log).unwrap().to_csv();
        let expected = "# mcu = STM32F407VGTx\nPin,ADC,TIM,Other\nPA2,-,-,-\n\
                        PA10,ADC2_IN4 ADC13_IN1,TIM2_CH2@1,ETH_REF_CLK@11\n";
        assert_eq!(csv, expected);
    }
}
