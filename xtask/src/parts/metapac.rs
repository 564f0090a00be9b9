//! The crate `stm32-metapac`: its generated sources in, pins and usages of each chip out.
//!
//! The sources are scanned as text: compiling them would take a build for each chip.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use anyhow::{Context as _, Result};

use super::sources::{entries, text};

/// The usages of each pin; an ADC input is one usage of all its units.
pub(crate) type Pins = BTreeMap<String, BTreeSet<(String, Option<u8>)>>;

/// All chips by name.
pub(crate) fn read(folder: &Path) -> Result<BTreeMap<String, Pins>> {
    let mut bodies: BTreeMap<String, Pins> = BTreeMap::new();
    let mut chips = BTreeMap::new();
    for path in entries(folder)?.into_iter().filter(|path| path.is_dir()) {
        let head = text(&path.join("metadata.rs"))?;
        let name = between(&head, "name: \"", "\"").context("a chip without a name")?;
        let body = between(&head, "include!(\"../", "\"").context("a chip without facts")?;
        if !bodies.contains_key(body) {
            bodies.insert(body.to_owned(), pins(&text(&folder.join(body))?)?);
        }
        let Some(pins) = bodies.get(body) else { continue };
        // The cores of a chip share its pins.
        let own: &mut Pins = chips.entry(name.to_owned()).or_default();
        for (pin, usages) in pins {
            own.entry(pin.clone()).or_default().extend(usages.iter().cloned());
        }
    }
    Ok(chips)
}

fn between<'a>(text: &'a str, start: &str, end: &str) -> Option<&'a str> {
    Some(text.split_once(start)?.1.split_once(end)?.0)
}

fn pins(source: &str) -> Result<Pins> {
    let mut pins = Pins::new();
    let mut converters: BTreeMap<(String, String), BTreeSet<String>> = BTreeMap::new();
    for peripheral in source.split("\n    Peripheral {").skip(1) {
        let unit = between(peripheral, "name: \"", "\"").context("a peripheral without a name")?;
        for entry in peripheral.split("PeripheralPin {").skip(1) {
            let entry = entry.split_once('}').map_or(entry, |(entry, _)| entry);
            let pin = between(entry, "pin: \"", "\"").context("no pin")?.to_owned();
            let line = between(entry, "signal: \"", "\"").context("no signal")?;
            let analog = line.starts_with("IN");
            if let Some(number) = unit.strip_prefix("ADC").filter(|_| analog) {
                let units = converters.entry((pin, line.to_owned())).or_default();
                units.insert(number.to_owned());
                continue;
            }
            let alternate = match between(entry, "af: ", ",").context("no function")?.trim() {
                "None" => None,
                some => {
                    Some(some.trim_start_matches("Some(").trim_end_matches(')').trim().parse()?)
                }
            };
            let blocks = remap_blocks(peripheral, &pin).unwrap_or_default();
            pins.entry(pin).or_default().insert((usage(unit, line) + &blocks, alternate));
        }
    }
    // On families whose data sheets name an input without its sign (`IN2`), an inverted input
    // (`INN1`) is no signal of a pin but another use of `IN2`.
    let signed = converters.keys().any(|(_, line)| line.starts_with("INP"));
    converters.retain(|(_, line), _| signed || !line.starts_with("INN"));
    for ((pin, line), units) in converters {
        let units: String = units.into_iter().collect();
        pins.entry(pin).or_default().insert((format!("ADC{units}_{line}"), None));
    }
    Ok(pins)
}

/// The remap blocks in which a peripheral has signals on a pin, as a table writes them: `#0|2`. On
/// other families than F1 there are none.
fn remap_blocks(peripheral: &str, pin: &str) -> Option<String> {
    let (_, blocks) = peripheral.split_once("afio: Some(PeripheralAfio {")?;
    let quoted = format!("\"{pin}\"");
    let numbers = blocks.split("PeripheralAfioValue {").skip(1).filter_map(|block| {
        let pins = between(block, "pins: &[", "]")?;
        pins.contains(&quoted).then(|| between(block, "value: ", ","))?
    });
    let numbers: Vec<&str> = numbers.collect();
    (!numbers.is_empty()).then(|| format!("#{}", numbers.join("|")))
}

/// I2S is part of a SPI unit there, and some break inputs are cut short.
fn usage(unit: &str, line: &str) -> String {
    match (unit.strip_prefix("SPI"), line.strip_prefix("I2S_")) {
        (Some(number), Some(line)) => format!("I2S{number}_{line}"),
        _ if unit.starts_with("TIM") && line == "BK" => format!("{unit}_BKIN"),
        _ if unit.starts_with("TIM") && line == "BK2" => format!("{unit}_BKIN2"),
        _ => format!("{unit}_{line}"),
    }
}
