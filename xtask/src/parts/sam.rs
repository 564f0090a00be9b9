//! The SAM D21, D51 and E5x files of `modm-devices`.

mod iosets;

use std::collections::BTreeMap;
use std::path::Path;

use anyhow::{Context as _, Result, ensure};
use roxmltree::{Document, Node};

use super::metapac::Pins;
use super::modm::{Identity, applies, child, children, identities, spell};
use super::sources::text;

/// A part.
pub(crate) struct Sam {
    /// The number without package and grade: `ATSAMD21G18A`.
    pub(crate) base: String,
    /// The packages with their grades: `-AU`.
    pub(crate) codes: Vec<String>,
    pub(crate) pins: Pins,
    pub(crate) core: &'static str,
    pub(crate) flash_bytes: usize,
    pub(crate) ram_bytes: usize,
}

/// What the parts of a file are.
struct Line {
    file: &'static str,
    core: &'static str,
    /// The channels of each timer for control, from the data sheet.
    channels: &'static [u8],
    /// Blocks of a SERCOM's pads as SPI: the settings of DOPO in which each line may be at each pad. They are those of
    /// the data sheet, without one of two inputs where lines that agree in pairs would not agree all together.
    spi: &'static [(&'static str, &'static str)],
    /// The same as UART: the settings of TXPO.
    uart: &'static [(&'static str, &'static str)],
    /// Whether the pads of a SERCOM must be of one set.
    has_sets: bool,
    /// RAM in KiB for each code of the flash's size.
    ram_kib: &'static [(&'static str, usize)],
}

const LINES: [Line; 2] = [
    Line {
        file: "samd21.xml",
        core: "Cortex-M0+",
        channels: &[4, 2, 2, 4],
        spi: &[
            ("0", "MOSI#0|3"),
            ("0", "MISO#1|2"),
            ("1", "SCK#0|2"),
            ("1", "MISO#1|3"),
            ("2", "MOSI#1"),
            ("2", "MISO#0|2"),
            ("3", "MOSI#2"),
            ("3", "SCK#1|3"),
            ("3", "MISO#0"),
        ],
        uart: &[
            ("0", "TX#4"),
            ("0", "RX#5"),
            ("1", "RX#4|5"),
            ("2", "TX#5"),
            ("2", "RX#4"),
            ("3", "RX#4|5"),
        ],
        has_sets: false,
        ram_kib: &[("15", 4), ("16", 8), ("17", 16), ("18", 32)],
    },
    Line {
        file: "samd51_e51_e53_e54.xml",
        core: "Cortex-M4",
        channels: &[6, 4, 3, 2, 2],
        spi: &[
            ("0", "MOSI#0"),
            ("0", "MISO#2"),
            ("1", "SCK#0|2"),
            ("2", "MISO#0|2"),
            ("3", "MOSI#2"),
            ("3", "MISO#0"),
        ],
        uart: &[("0", "TX"), ("1", "RX"), ("2", "RX"), ("3", "RX")],
        has_sets: true,
        ram_kib: &[("18", 128), ("19", 192), ("20", 256)],
    },
];

/// Reads the files.
pub(crate) fn read(folder: &Path) -> Result<Vec<Sam>> {
    let mut parts: BTreeMap<String, Sam> = BTreeMap::new();
    for line in &LINES {
        let text = text(&folder.join(line.file))?;
        let document = Document::parse(&text).with_context(|| line.file.to_owned())?;
        let root = child(document.root_element(), "device").context("no device")?;
        let schema =
            child(root, "naming-schema").and_then(|node| node.text()).context("no schema")?;
        for identity in identities(root, schema) {
            let name = spell(schema, &identity).to_uppercase();
            let (base, code) = name.split_once('-').context("no package")?;
            // The grades differ in temperature alone; the chips for 48 contacts without USB are another variant.
            let is_plain =
                matches!(code, "AU" | "MU") && identity.get("variant").is_some_and(|v| v == "a");
            let flash = identity.get("flash").map(String::as_str).unwrap_or_default();
            let ram = line.ram_kib.iter().find(|(of, _)| *of == flash);
            let (true, Some((_, ram_kib))) = (is_plain, ram) else { continue };
            let base = format!("AT{base}");
            if let Some(part) = parts.get_mut(&base) {
                part.codes.push(format!("-{code}"));
                continue;
            }
            let exponent: u32 = flash.parse()?;
            let part = Sam {
                base: base.clone(),
                codes: vec![format!("-{code}")],
                pins: pins(line, root, &identity)?,
                core: line.core,
                flash_bytes: 1 << exponent,
                ram_bytes: ram_kib << 10,
            };
            parts.insert(base, part);
        }
    }
    Ok(parts.into_values().collect())
}

fn pins(line: &Line, root: Node<'_, '_>, identity: &Identity) -> Result<Pins> {
    let mut gpio = children(root, "driver").filter(|node| node.attribute("name") == Some("gpio"));
    let gpio = gpio.find(|node| applies(*node, identity)).context("no pins")?;
    let mut pins = Pins::new();
    for node in children(gpio, "gpio").filter(|node| applies(*node, identity)) {
        let attribute = |name: &str| node.attribute(name).context("no name");
        let number: u8 = attribute("pin")?.parse()?;
        let pin = format!("P{}{number}", attribute("port")?);
        let usages = pins.entry(pin.clone()).or_default();
        for signal in children(node, "signal").filter(|node| applies(*node, identity)) {
            // The multiplexer's setting is a letter, and a number for us: A is 0.
            let function = signal.attribute("function").unwrap_or_default();
            let setting = match function.as_bytes() {
                [letter @ b'a'..=b'p'] => Some(letter - b'a'),
                _ => None,
            };
            usages.extend(named(line, &pin, signal)?.into_iter().map(|name| (name, setting)));
        }
    }
    Ok(pins)
}

/// A SERCOM's line with the blocks that it is in on a pin: of each set the two orders of SPI lines (DOPO 0 and 2), and
/// of a line of another bus both of them.
fn in_sets(line: &str, sets: &[u8]) -> String {
    let (line, orders) = line.split_once('#').unwrap_or((line, "0|2"));
    let orders: Vec<u8> = ["0", "2"]
        .into_iter()
        .zip(0..)
        .filter_map(|(order, at)| orders.contains(order).then_some(at))
        .collect();
    let blocks = sets.iter().flat_map(|set| orders.iter().map(move |order| (set - 1) * 2 + order));
    let blocks: Vec<String> = blocks.map(|block| block.to_string()).collect();
    format!("{line}#{}", blocks.join("|"))
}

/// The usages that a signal of the file is on a pin.
fn named(line: &Line, pin: &str, signal: Node<'_, '_>) -> Result<Vec<String>> {
    let of = |name: &str| signal.attribute(name).unwrap_or_default();
    let (driver, unit, name, index) = (of("driver"), of("instance"), of("name"), of("index"));
    Ok(match (driver, name) {
        ("sercom", _) => {
            let bus = [("0", "SDA"), ("1", "SCL")];
            let lines = bus.iter().chain(line.spi).chain(line.uart);
            let lines = lines.filter(|(pad, _)| *pad == index).map(|(_, line)| *line);
            let sets: Vec<u8> = iosets::sets_of(unit, index, pin).collect();
            ensure!(!line.has_sets || !sets.is_empty(), "{pin} is in no set of SERCOM{unit}");
            let spelled =
                |own: &str| if line.has_sets { in_sets(own, &sets) } else { own.to_owned() };
            lines.map(|own| format!("SERCOM{unit}_{}", spelled(own))).collect()
        }
        ("tcc", "wo") => {
            let own = unit.parse::<usize>().ok().and_then(|unit| line.channels.get(unit));
            let channels = own.copied().unwrap_or(2);
            let is_own = index.parse::<u8>().is_ok_and(|index| index < channels);
            // Further outputs repeat those of the channels.
            let again = if is_own { "" } else { "_AGAIN" };
            vec![format!("TCC{unit}_WO{index}{again}")]
        }
        ("tc", "wo") => vec![format!("TC{unit}_WO{index}")],
        // The touch controller is at nearly all pins, at each as what it drives and what it measures.
        ("ptc", _) | ("adc", "x" | "y") => vec!["PTC".to_owned()],
        ("adc", "ain") => vec![format!("ADC{unit}_IN{index}")],
        ("dac", "vout") => {
            let output = index.parse::<u8>().unwrap_or(0) + 1;
            vec![format!("DAC1_OUT{output}")]
        }
        ("adc" | "dac", reference) => vec![reference.to_uppercase()],
        ("can", line) => vec![format!("CAN{unit}_{line}").to_uppercase()],
        ("pdec", "qdi") => vec![format!("PDEC_QDI{index}")],
        ("eic", _) => Vec::new(),
        (driver, name) => vec![format!("{driver}{unit}_{name}{index}").to_uppercase()],
    })
}
