//! The nRF52 files of `modm-devices`, with the peripherals that may be at any pin.

use std::path::Path;

use anyhow::{Context as _, Result};
use roxmltree::{Document, Node};
use sensedsl_board::table::ROUTED;

use super::metapac::Pins;
use super::modm::{Identity, applies, child, children, identities, places, spell};
use super::sources::text;

/// A part: one chip in one package.
pub(crate) struct Part {
    pub(crate) base: String,
    /// Package and memory: `-QIAA`.
    pub(crate) code: String,
    pub(crate) pins: Pins,
    /// The package and its positions, if they are known.
    pub(crate) layout: Option<(String, Vec<(String, String)>)>,
    pub(crate) core: &'static str,
    pub(crate) flash_bytes: usize,
    pub(crate) ram_bytes: usize,
}

/// What a chip has, from its product specification. Peripherals that share a block with another are left out: the
/// first two units of SPI are those of TWI.
struct Chip {
    name: &'static str,
    file: &'static str,
    spis: &'static [u8],
    serials: u8,
    pulses: u8,
    kib: (usize, usize),
}

const CHIPS: [Chip; 3] = [
    Chip {
        name: "nrf52832",
        file: "nrf52832_833.xml",
        spis: &[2],
        serials: 1,
        pulses: 3,
        kib: (512, 64),
    },
    Chip {
        name: "nrf52833",
        file: "nrf52832_833.xml",
        spis: &[2, 3],
        serials: 2,
        pulses: 4,
        kib: (512, 128),
    },
    Chip {
        name: "nrf52840",
        file: "nrf52820_840.xml",
        spis: &[2, 3],
        serials: 2,
        pulses: 4,
        kib: (1024, 256),
    },
];

/// Reads the files of these chips.
pub(crate) fn read(folder: &Path) -> Result<Vec<Part>> {
    let mut parts = Vec::new();
    for chip in &CHIPS {
        let text = text(&folder.join(chip.file))?;
        let document = Document::parse(&text).with_context(|| chip.file.to_owned())?;
        let root = child(document.root_element(), "device").context("no device")?;
        let schema =
            child(root, "naming-schema").and_then(|node| node.text()).context("no schema")?;
        for identity in identities(root, schema) {
            let name = spell(schema, &identity);
            let Some(code) = name.strip_prefix(chip.name) else { continue };
            let is_small = code.ends_with("ab");
            let kib = if is_small { (256, 32) } else { chip.kib };
            let gpio = children(root, "driver");
            let mut gpio = gpio.filter(|node| node.attribute("name") == Some("gpio"));
            let gpio = gpio.find(|node| applies(*node, &identity)).context("no pins")?;
            let package = children(gpio, "package").find(|one| applies(*one, &identity));
            parts.push(Part {
                base: chip.name.to_uppercase(),
                code: code.to_uppercase(),
                pins: pins(chip, gpio, &identity)?,
                layout: package.and_then(|package| {
                    Some((package.attribute("name")?.to_owned(), places(package, &identity)))
                }),
                core: "Cortex-M4",
                flash_bytes: kib.0 << 10,
                ram_bytes: kib.1 << 10,
            });
        }
    }
    Ok(parts)
}

fn pins(chip: &Chip, gpio: Node<'_, '_>, identity: &Identity) -> Result<Pins> {
    let mut pins = Pins::new();
    for node in children(gpio, "gpio").filter(|node| applies(*node, identity)) {
        let attribute = |name: &str| node.attribute(name).context("no name");
        let number: u8 = attribute("pin")?.parse()?;
        let usages = pins.entry(format!("P{}.{number:02}", attribute("port")?)).or_default();
        // The file does not say which inputs nRF52832 has; its product specification has the same.
        let has = |node: &Node<'_, '_>| {
            applies(*node, identity) || node.attribute("driver") == Some("saadc")
        };
        for signal in children(node, "signal").filter(has) {
            let of = |name: &str| signal.attribute(name).unwrap_or_default();
            match (of("driver"), of("name")) {
                ("saadc", input) => {
                    usages.insert((input.replace("ain", "ADC1_IN"), None));
                }
                // The comparators have the inputs of the converter.
                ("comp" | "lpcomp", _) => {}
                (driver, name) => {
                    usages.insert((format!("{driver}_{name}").to_uppercase(), None));
                }
            }
        }
        usages.extend(routed(chip).into_iter().map(|name| (format!("{ROUTED}{name}"), None)));
    }
    Ok(pins)
}

/// The signals that may be at any pin.
fn routed(chip: &Chip) -> Vec<String> {
    let mut names = Vec::new();
    let mut add = |unit: &str, lines: &[&str]| {
        names.extend(lines.iter().map(|line| format!("{unit}_{line}")));
    };
    for unit in 0..2 {
        add(&format!("TWIM{unit}"), &["SCL", "SDA"]);
    }
    for unit in chip.spis {
        add(&format!("SPIM{unit}"), &["SCK", "MISO", "MOSI"]);
    }
    for unit in 0..chip.serials {
        add(&format!("UARTE{unit}"), &["TX", "RX"]);
    }
    for unit in 0..chip.pulses {
        add(&format!("PWM{unit}"), &["OUT0", "OUT1", "OUT2", "OUT3"]);
    }
    add("QDEC", &["A", "B"]);
    // The first timer is that of the radio.
    for unit in 1..5 {
        add(&format!("TIMER{unit}"), &["CC0"]);
    }
    names
}
