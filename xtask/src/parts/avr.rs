//! The ATDF files of the crate `avr-device`, from which the AVRs of the Arduino boards are read.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use anyhow::{Context as _, Result, ensure};
use roxmltree::{Document, Node};

use super::metapac::Pins;
use super::sources::text;

/// An AVR: the usages of its pads, and its packages.
pub(crate) struct Avr {
    pub(crate) base: String,
    pub(crate) pins: Pins,
    /// The core: `AVR8`.
    pub(crate) core: String,
    pub(crate) flash_bytes: usize,
    pub(crate) ram_bytes: usize,
    /// The package, and the positions with their pads, by order code.
    pub(crate) variants: BTreeMap<String, (String, Vec<(String, String)>)>,
}

/// The parts on Arduino boards and similar ones.
const PARTS: [&str; 7] = [
    "atmega168",
    "atmega328p",
    "atmega328pb",
    "atmega32u4",
    "atmega1280",
    "atmega1284p",
    "atmega2560",
];

/// Reads the files of these parts.
pub(crate) fn read(folder: &Path) -> Result<Vec<Avr>> {
    PARTS.iter().map(|name| one(folder, name)).collect()
}

fn one(folder: &Path, name: &str) -> Result<Avr> {
    let text = text(&folder.join(format!("{name}.atdf")))?;
    let document = Document::parse(&text).with_context(|| name.to_owned())?;
    let nodes = |tag: &'static str| document.descendants().filter(move |n| n.has_tag_name(tag));
    let mut pins = Pins::new();
    for instance in nodes("instance") {
        let unit = instance.attribute("name").unwrap_or_default();
        for signal in instance.descendants().filter(|node| node.has_tag_name("signal")) {
            let Some(pad) = signal.attribute("pad") else { continue };
            let group = signal.attribute("group").unwrap_or_default();
            let index = signal.attribute("index").unwrap_or_default();
            let usages: &mut BTreeSet<_> = pins.entry(pad.to_owned()).or_default();
            if let Some(usage) = usage(unit, group, index) {
                usages.insert((usage, None));
            }
        }
    }
    // Converter inputs that are not port pins appear only in the pinouts.
    for pad in nodes("pin").filter_map(|pin| pin.attribute("pad")) {
        if let Some(input) = pad.strip_prefix("ADC").filter(|input| input.parse::<u8>().is_ok()) {
            let usage = (format!("ADC1_IN{input}"), None);
            pins.entry(pad.to_owned()).or_default().insert(usage);
        }
    }
    let places = |pinout: &str| -> Vec<(String, String)> {
        let pinout = nodes("pinout").find(|node| node.attribute("name") == Some(pinout));
        let list = pinout.into_iter().flat_map(|node: Node<'_, '_>| node.children());
        let place = |node: Node<'_, '_>| {
            let pad = node.attribute("pad")?;
            let position = node.attribute("position")?.to_owned();
            pins.contains_key(pad).then(|| (position, pad.to_owned()))
        };
        list.filter_map(place).collect()
    };
    let base = name.to_uppercase();
    let mut variants = BTreeMap::new();
    for variant in nodes("variant") {
        let attribute = |name: &str| variant.attribute(name).unwrap_or_default().to_owned();
        let Some(code) =
            attribute("ordercode").to_uppercase().strip_prefix(&base).map(str::to_owned)
        else {
            continue;
        };
        let found = places(&attribute("pinout"));
        if !found.is_empty() {
            variants.insert(code, (attribute("package"), found));
        }
    }
    let core = nodes("device").find_map(|node| node.attribute("architecture"));
    Ok(Avr {
        base,
        pins,
        core: core.context("no architecture")?.to_owned(),
        flash_bytes: memory(&document, "flash")?,
        ram_bytes: memory(&document, "ram")?,
        variants,
    })
}

/// The size in bytes of the internal memory of a type. Segments for a boot loader are part of the flash.
fn memory(document: &Document<'_>, of: &str) -> Result<usize> {
    let segments = document.descendants().filter(|node| {
        node.has_tag_name("memory-segment")
            && node.attribute("type") == Some(of)
            && node.attribute("external") != Some("true")
            && node.attribute("name").is_some_and(|name| !name.starts_with("BOOT_"))
    });
    let sizes = segments.map(|node| {
        let size = node.attribute("size").and_then(|size| size.strip_prefix("0x"));
        usize::from_str_radix(size.context("no size")?, 16).context("no number")
    });
    let sum: usize = sizes.sum::<Result<_>>()?;
    ensure!(sum > 0, "no {of}");
    Ok(sum)
}

/// The usage as in the data sheets, with the unit in front if the signal alone is ambiguous (`TWI_SCL`); `None` for the
/// port itself, and for the programmer's lines.
fn usage(unit: &str, group: &str, index: &str) -> Option<String> {
    let number = unit.trim_start_matches(|c: char| !c.is_ascii_digit());
    let usage = match (unit.strip_suffix(number).unwrap_or(unit), group) {
        (start, _) if start.starts_with("PORT") => return None,
        ("SPI", "PDI" | "PDO") => return None,
        ("ADC", "ADC") => format!("ADC1_IN{index}"),
        ("TWI" | "SPI", line) => format!("{unit}_{line}"),
        ("USART", "TXD") => format!("{unit}_TX"),
        ("USART", "RXD") => format!("{unit}_RX"),
        ("USART", "XCK") => format!("{unit}_CK"),
        ("USART", line) => format!("{unit}_{line}"),
        ("TC", line) => match line.strip_prefix("_OC").or_else(|| line.strip_prefix("OC")) {
            Some(output) => {
                format!("OC{number}{output}{}", if line.starts_with('_') { "N" } else { "" })
            }
            None => format!("{line}{number}"),
        },
        (_, line) => format!("{line}{index}"),
    };
    Some(usage)
}
