//! The nRF52 and nRF53 files of `modm-devices`, with the peripherals that may be at any pin.

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

/// What a chip has, from its product specification. Of the peripherals that share a block with another on nRF52, one is
/// named: the first two units of SPI are those of TWI.
struct Chip {
    name: &'static str,
    file: &'static str,
    /// Blocks that are a bus of any kind.
    blocks: u8,
    i2cs: u8,
    spis: &'static [u8],
    serials: u8,
    pulses: u8,
    decoders: &'static [&'static str],
    /// Without the radio's.
    timers: std::ops::Range<u8>,
    core: &'static str,
    kib: (usize, usize),
}

const NRF52: Chip = Chip {
    name: "nrf52840",
    file: "nrf52820_840.xml",
    blocks: 0,
    i2cs: 2,
    spis: &[2, 3],
    serials: 2,
    pulses: 4,
    decoders: &["QDEC"],
    timers: 1..5,
    core: "Cortex-M4",
    kib: (1024, 256),
};

const CHIPS: [Chip; 4] = [
    Chip {
        name: "nrf52832",
        file: "nrf52832_833.xml",
        spis: &[2],
        serials: 1,
        pulses: 3,
        kib: (512, 64),
        ..NRF52
    },
    Chip { name: "nrf52833", file: "nrf52832_833.xml", kib: (512, 128), ..NRF52 },
    NRF52,
    // The core for applications; the other one is the radio's.
    Chip {
        name: "nrf5340",
        file: "nrf5340.xml",
        blocks: 4,
        i2cs: 0,
        spis: &[4],
        serials: 0,
        decoders: &["QDEC0", "QDEC1"],
        timers: 0..3,
        core: "Cortex-M33",
        kib: (1024, 512),
        ..NRF52
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
            let (code, core) = code.split_once('@').unwrap_or((code, "app"));
            if core != "app" {
                continue;
            }
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
                core: chip.core,
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
                // A bus with fast pins of its own may be at any others.
                ("spim" | "twim" | "twis", _) => {}
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
    for unit in 0..chip.blocks {
        let lines = ["SCL", "SDA", "SCK", "MISO", "MOSI", "TX", "RX"];
        add(&format!("SERIAL{unit}"), &lines);
    }
    for unit in 0..chip.i2cs {
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
    for unit in chip.decoders {
        add(unit, &["A", "B"]);
    }
    for unit in chip.timers.clone() {
        add(&format!("TIMER{unit}"), &["CC0"]);
    }
    names
}
