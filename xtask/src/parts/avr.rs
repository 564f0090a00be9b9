//! The ATDF files of the crate `avr-device`: the AVRs of the Arduino boards out.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use anyhow::{Context as _, Result};
use roxmltree::{Document, Node};

use super::metapac::Pins;
use super::sources::text;

/// An AVR: the usages of its pads, and its packages.
pub(crate) struct Avr {
    pub(crate) base: String,
    pub(crate) pins: Pins,
    /// By order code: the package, and positions with pads.
    pub(crate) variants: BTreeMap<String, (String, Vec<(String, String)>)>,
}

/// Reads the files of the parts that are wanted.
pub(crate) fn read(folder: &Path) -> Result<Vec<Avr>> {
    ["atmega328p", "atmega2560"].iter().map(|name| one(folder, name)).collect()
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
    Ok(Avr { base, pins, variants })
}

/// The usage in the names of the language. A compare output cannot capture, so outputs A, B and C
/// of a timer are its channels 3, 4 and 5, which no capture asks for; none for the port itself.
fn usage(unit: &str, group: &str, index: &str) -> Option<String> {
    let digits = |text: &str| text.chars().filter(char::is_ascii_digit).collect::<String>();
    let number = digits(unit);
    let usage = match (unit.trim_end_matches(|c: char| c.is_ascii_digit()), group) {
        (start, _) if start.starts_with("PORT") => return None,
        ("ADC", "ADC") => format!("ADC1_IN{index}"),
        ("TWI", line) => format!("I2C0_{line}"),
        ("SPI", "SS") => "SPI0_NSS".to_owned(),
        ("SPI", line) => format!("SPI0_{line}"),
        ("USART", "TXD") => format!("USART{number}_TX"),
        ("USART", "RXD") => format!("USART{number}_RX"),
        ("USART", _) => format!("USART{number}_CK"),
        ("TC", "OCA") => format!("TIM{number}_CH3"),
        ("TC", "OCB") => format!("TIM{number}_CH4"),
        ("TC", "OCC") => format!("TIM{number}_CH5"),
        ("TC", line) => format!("{line}{number}"),
        (_, line) => format!("{line}{index}"),
    };
    Some(usage)
}
