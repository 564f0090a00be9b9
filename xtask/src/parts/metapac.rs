//! The crate `stm32-metapac`. In: its generated sources. Out: pins, usages and memory of each chip.
//!
//! The sources are scanned as text: to compile them would take a build for each chip.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use anyhow::{Context as _, Result, ensure};

use super::sources::{entries, text};

/// The usages of each pin; an ADC input is one usage for all its units.
pub(crate) type Pins = BTreeMap<String, BTreeSet<(String, Option<u8>)>>;

/// A chip.
#[derive(Clone, Debug, Default)]
pub(crate) struct Chip {
    pub(crate) pins: Pins,
    pub(crate) flash_bytes: usize,
    pub(crate) ram_bytes: usize,
}

/// All chips by name.
pub(crate) fn read(folder: &Path) -> Result<BTreeMap<String, Chip>> {
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
        // The cores of a chip share its pins and its memory.
        let own: &mut Chip = chips.entry(name.to_owned()).or_default();
        for (pin, usages) in pins {
            own.pins.entry(pin.clone()).or_default().extend(usages.iter().cloned());
        }
        (own.flash_bytes, own.ram_bytes) = memory(&head).with_context(|| name.to_owned())?;
    }
    Ok(chips)
}

pub(crate) fn between<'a>(text: &'a str, start: &str, end: &str) -> Option<&'a str> {
    Some(text.split_once(start)?.1.split_once(end)?.0)
}

/// The bytes of flash and of RAM. A chip whose flash is one bank or two, depending on its option bytes, has a list of
/// regions for each case: both have the same sum.
fn memory(head: &str) -> Result<(usize, usize)> {
    let lists = between(head, "memory: ", "peripherals: ").context("no memory")?;
    let mut sums = BTreeSet::new();
    for list in lists.split("&[").filter(|list| list.contains("MemoryRegion {")) {
        let (mut flash, mut ram) = (0, 0);
        for region in list.split("MemoryRegion {").skip(1) {
            let field = |start: &str| between(region, start, ",").context("half a region");
            let name = field("name: \"")?.trim_end_matches('"');
            let size: usize = field("size: ")?.parse()?;
            let address = u32::from_str_radix(field("address: 0x")?, 16)?;
            match field("kind: MemoryRegionKind::")? {
                "Flash" if name != "OTP" => flash += size,
                "Ram" if is_counted(name, address) => ram += size.next_multiple_of(RESERVED),
                _ => {}
            }
        }
        sums.insert((flash, ram));
    }
    ensure!(sums.len() == 1, "lists of regions with other sums: {sums:?}");
    sums.first().copied().context("no regions")
}

/// Whether RAM is counted: not if it is a second address for instruction fetches, if a battery keeps it, or if it is on
/// an external bus.
fn is_counted(name: &str, address: u32) -> bool {
    !name.ends_with("_ICODE") && name != "BKPSRAM" && address < EXTERNAL
}

/// The first address of external memory on a Cortex-M.
const EXTERNAL: u32 = 0x6000_0000;
/// A reserved part of RAM, such as the first bytes on STM32WB0, is smaller than this. It is counted, as in the data
/// sheets.
pub(crate) const RESERVED: usize = 512;

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
    // On families whose data sheets name an input without its sign (`IN2`), an inverted input (`INN1`) is not a signal
    // of a pin but another use of `IN2`.
    let signed = converters.keys().any(|(_, line)| line.starts_with("INP"));
    converters.retain(|(_, line), _| signed || !line.starts_with("INN"));
    for ((pin, line), units) in converters {
        let units: String = units.into_iter().collect();
        pins.entry(pin).or_default().insert((format!("ADC{units}_{line}"), None));
    }
    Ok(pins)
}

/// The remap blocks in which a peripheral has signals on a pin, as a table writes them: `#0|2`. Only the F1 family has
/// any.
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

/// The usage of a pin: in this source, I2S is part of an SPI unit, and some break inputs have shortened names.
fn usage(unit: &str, line: &str) -> String {
    match (unit.strip_prefix("SPI"), line.strip_prefix("I2S_")) {
        (Some(number), Some(line)) => format!("I2S{number}_{line}"),
        _ if unit.starts_with("TIM") && line == "BK" => format!("{unit}_BKIN"),
        _ if unit.starts_with("TIM") && line == "BK2" => format!("{unit}_BKIN2"),
        _ => format!("{unit}_{line}"),
    }
}
