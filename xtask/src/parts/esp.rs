//! The crate `esp-metadata-generated`, whose macros list the pins and signals of ESP32 chips.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use anyhow::{Context as _, Result, ensure};
use sensedsl_board::pin::PinName;
use sensedsl_board::silicon::{PinRole, input_only, pin_roles};
use sensedsl_board::table::ROUTED;

use super::metapac::Pins;
use super::sources::text;

/// A chip: the usages of its pins, and what it has.
pub(crate) struct Esp {
    pub(crate) base: &'static str,
    pub(crate) pins: Pins,
    pub(crate) core: &'static str,
    pub(crate) ram_bytes: usize,
}

/// The file of a chip, its name, its cores according to its data sheet, and its units of the pulse counter and of the
/// receiver of pulses.
const CHIPS: [(&str, &str, &str, usize, usize); 6] = [
    ("esp32", "ESP32", "Xtensa LX6 + Xtensa LX6", 8, 8),
    ("esp32s2", "ESP32-S2", "Xtensa LX7", 4, 4),
    ("esp32s3", "ESP32-S3", "Xtensa LX7 + Xtensa LX7", 4, 4),
    ("esp32c3", "ESP32-C3", "RISC-V", 0, 2),
    ("esp32c6", "ESP32-C6", "RISC-V", 4, 2),
    ("esp32h2", "ESP32-H2", "RISC-V", 4, 2),
];

/// Reads the files of these chips.
pub(crate) fn read(folder: &Path) -> Result<Vec<Esp>> {
    let mut chips = Vec::new();
    for (file, base, core, counters, receivers) in CHIPS {
        let text = text(&folder.join(format!("_generated_{file}.rs")))?;
        let text: String = text.split_whitespace().collect::<Vec<_>>().join(" ");
        let pins = pins(&text, counters, receivers).with_context(|| base.to_owned())?;
        let ram = text.split("(size as str, \"DRAM\") => { \"").nth(1).context("no RAM")?;
        let ram_bytes = ram.split('"').next().unwrap_or_default().parse()?;
        check(&text, base)?;
        chips.push(Esp { base, pins, core, ram_bytes });
    }
    Ok(chips)
}

/// The calls of a macro about one thing each: `3, GPIO3(_0 => …`. Those about all of them begin with a word and `(`.
fn calls<'a>(text: &'a str, of: &str) -> Vec<&'a str> {
    let start = format!("_for_each_inner_{of}!((");
    let calls = text.split(start.as_str()).skip(1).filter_map(|rest| rest.split(");").next());
    let is_one = |call: &&str| match (call.split_once(','), call.split_once('(')) {
        (Some((word, _)), Some((of_all, _))) => word.len() < of_all.len(),
        (_, of_all) => of_all.is_none(),
    };
    calls.filter(is_one).collect()
}

fn pins(text: &str, counters: usize, receivers: usize) -> Result<Pins> {
    let routed = routed(text, counters, receivers);
    let mut pins = Pins::new();
    for call in calls(text, "gpio") {
        let (_, rest) = call.split_once(", ").context("no number")?;
        let (pin, functions) = rest.split_once('(').with_context(|| rest.to_owned())?;
        let is_output = functions.contains("[Output]");
        let usages: &mut BTreeSet<_> = pins.entry(pin.trim().to_owned()).or_default();
        for function in functions.split(" _").flat_map(|part| part.split("(_")) {
            let Some((number, name)) = function.split_once(" => ") else { continue };
            let number = number.trim_start_matches(['(', '_']).parse::<u8>().ok();
            let name = name.split([' ', ')']).next().unwrap_or_default();
            let name = own(text, name);
            if usages.iter().all(|(known, _)| *known != name) {
                usages.insert((name, number));
            }
        }
        let own: BTreeSet<String> = usages.iter().map(|(name, _)| name.clone()).collect();
        for (name, is_input) in &routed {
            if !own.contains(name) && (is_output || *is_input) {
                usages.insert((format!("{ROUTED}{name}"), None));
            }
        }
    }
    for call in calls(text, "analog_function") {
        let (name, pin) = call.split_once(", ").context("no pin")?;
        // The amplifier of the first ESP32 is not described any more.
        if name == "ADC_H" {
            continue;
        }
        let usages = pins.get_mut(pin.trim_end_matches(')')).with_context(|| pin.to_owned())?;
        usages.insert((analog(name), None));
    }
    ensure!(pins.len() > 10, "{} pins", pins.len());
    Ok(pins)
}

/// The signals that the matrix carries to any pin, each with whether the chip reads it.
fn routed(text: &str, counters: usize, receivers: usize) -> Vec<(String, bool)> {
    let mut routed = Vec::new();
    for unit in 0..calls(text, "i2c_master").len() {
        // The lines of the bus are driven by both ends.
        routed.extend([(format!("I2C{unit}_SCL"), false), (format!("I2C{unit}_SDA"), false)]);
    }
    for unit in 0..calls(text, "uart").len() {
        routed.extend([(format!("UART{unit}_TX"), false), (format!("UART{unit}_RX"), true)]);
    }
    for call in calls(text, "spi_master").into_iter().filter(|call| call.contains('[')) {
        let unit = call.split(',').next().unwrap_or_default();
        let lines = [("SCK", false), ("MISO", true), ("MOSI", false)];
        routed.extend(lines.map(|(line, is_input)| (format!("{unit}_{line}"), is_input)));
    }
    let has = |signal: &str| text.contains(signal);
    let outputs = |speed: char| (0..8).filter(move |at| has(&format!("LEDC_{speed}S_SIG{at}")));
    routed.extend(outputs('L').map(|at| (format!("LEDC{}_CH{at}", at / 2 % 4), false)));
    // The fast half of ESP32's controller has timers and channels of its own.
    routed.extend(outputs('H').map(|at| (format!("LEDC{}_CH{}", 4 + at / 2, 8 + at), false)));
    for unit in 0..counters {
        routed.extend([(format!("PCNT{unit}_A"), true), (format!("PCNT{unit}_B"), true)]);
    }
    routed.extend((0..receivers).map(|unit| (format!("RMT{unit}_IN"), true)));
    for unit in 0..2 {
        if has(&format!("TWAI{unit}_TX")) || (unit == 0 && has(" TWAI_TX")) {
            routed.extend([(format!("TWAI{unit}_TX"), false), (format!("TWAI{unit}_RX"), true)]);
        }
    }
    routed
}

/// The usage for a function of the pin's own multiplexer: `SPI2_SCK` for `FSPICLK`.
fn own(text: &str, name: &str) -> String {
    let of_unit = |stem: &str| -> Option<String> {
        let call = calls(text, "spi_master").into_iter().find(|call| {
            call.split(", ").nth(2).is_some_and(|own| own.starts_with(&format!("{stem}CLK")))
        })?;
        Some(call.split(',').next()?.to_owned())
    };
    let lines = [("CLK", "SCK"), ("Q", "MISO"), ("D", "MOSI"), ("CS0", "NSS")];
    for (end, line) in lines {
        if let Some(unit) = name.strip_suffix(end).and_then(of_unit) {
            return format!("{unit}_{line}");
        }
    }
    let serial = name.strip_prefix('U').and_then(|rest| Some((rest.get(..1)?, rest.get(1..)?)));
    match serial {
        Some((unit, "TXD")) if unit.parse::<u8>().is_ok() => format!("UART{unit}_TX"),
        Some((unit, "RXD")) if unit.parse::<u8>().is_ok() => format!("UART{unit}_RX"),
        _ => name.to_owned(),
    }
}

/// The usage for an analog function: `ADC1_IN3` for `ADC1_CH3`.
fn analog(name: &str) -> String {
    match name.strip_prefix("DAC") {
        Some(number) => format!("DAC1_OUT{number}"),
        None if name.starts_with("ADC") => name.replace("_CH", "_IN"),
        None => name.to_owned(),
    }
}

/// Compares the pins that the silicon's file keeps back with the limitations that the crate lists.
fn check(text: &str, base: &str) -> Result<()> {
    let mut limited: BTreeMap<&str, BTreeSet<PinName>> = BTreeMap::new();
    for part in text.split("@ peri_type #[doc = \"GPIO").skip(1) {
        let Some((number, rest)) = part.split_once(" peripheral singleton") else { continue };
        let doc = rest.split("<=").next().unwrap_or_default();
        let Some(pin) = PinName::parse(&format!("GPIO{number}")) else { continue };
        for (words, role) in [("strapping", "boot"), ("only be used as an input", "input")] {
            if doc.contains(words) {
                limited.entry(role).or_default().insert(pin.clone());
            }
        }
    }
    let roles = pin_roles(base).into_iter().filter(|(_, role)| *role == PinRole::Boot);
    let boot: BTreeSet<PinName> = roles.map(|(pin, _)| pin).collect();
    let of = |role: &str| limited.get(role).cloned().unwrap_or_default();
    ensure!(boot == of("boot"), "{base}: boot pins are {:?}", of("boot"));
    ensure!(input_only(base) == of("input"), "{base}: inputs are {:?}", of("input"));
    Ok(())
}
