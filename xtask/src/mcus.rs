//! `cargo xtask mcus [--check]`: writes the facts that the emulated machine needs about each MCU, or compares them.
//!
//! In: the metadata of the crate `stm32-metapac`, and [`MCUS`], which has the facts that they lack. Out: a file for
//! each MCU in `crates/machine/mcus/`. It gives the memories; block, version, address, clock and interrupts of each
//! unit; and the units that use each channel of the DMA.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::Path;

use anyhow::{Context as _, Result, bail, ensure};

use crate::parts::metapac::between;
use crate::parts::sources::{self, text};

const USAGE: &str = "cargo xtask mcus [--check]";

/// Parts that are the same to a program except for their packages and the size of their flash.
struct Mcu {
    /// The prefixes of the parts' names.
    parts: &'static [&'static str],
    /// The part with the most pads and memory.
    largest: &'static str,
    /// The MCU's identifier in the debug unit: `DBGMCU_IDCODE` in the reference manual.
    idcode: u32,
    /// The units for which the machine's model of their version is not correct.
    without: &'static [&'static str],
}

const MCUS: [Mcu; 5] = [
    Mcu { parts: &["STM32F401"], largest: "STM32F401VE", idcode: 0x1000_6433, without: &[] },
    Mcu {
        parts: &["STM32F405", "STM32F407", "STM32F415", "STM32F417"],
        largest: "STM32F407IG",
        idcode: 0x100F_6413,
        without: &[],
    },
    Mcu { parts: &["STM32F411"], largest: "STM32F411VE", idcode: 0x1000_6431, without: &[] },
    Mcu {
        parts: &["STM32F427", "STM32F429", "STM32F437", "STM32F439"],
        largest: "STM32F429NI",
        idcode: 0x2003_6419,
        without: &[],
    },
    // Its USB unit senses the bus in a different way.
    Mcu {
        parts: &["STM32F446"],
        largest: "STM32F446ZE",
        idcode: 0x1000_6421,
        without: &["USB_OTG_FS"],
    },
];

/// The registers of the RCC that enable clocks, and their offsets.
const ENABLES: [(&str, u32); 5] =
    [("AHB1ENR", 0x30), ("AHB2ENR", 0x34), ("AHB3ENR", 0x38), ("APB1ENR", 0x40), ("APB2ENR", 0x44)];

/// Runs the command.
pub(crate) fn run(arguments: &[String]) -> Result<()> {
    let is_check = match arguments {
        [] => false,
        [one] if one == "--check" => true,
        _ => bail!(USAGE),
    };
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let chips = sources::fetch(&root)?.metapac;
    let bits = clock_bits(&text(&chips.join("../registers/rcc_f4.rs"))?);
    let folder = root.join("crates/machine/mcus");
    std::fs::create_dir_all(&folder)?;
    let mut stale = Vec::new();
    for mcu in &MCUS {
        let printed = file(mcu, &chips, &bits).with_context(|| mcu.largest)?;
        let name = mcu.parts.first().context("no parts")?.to_lowercase();
        let path = folder.join(format!("{name}.toml"));
        if !is_check {
            sources::write(&path, printed.as_bytes())?;
        } else if std::fs::read_to_string(&path).ok().as_deref() != Some(&printed) {
            stale.push(name);
        }
    }
    ensure!(stale.is_empty(), "not as they would be written: {}", stale.join(", "));
    crate::say(&format!("{} MCUs\n", MCUS.len()))
}

/// The bit of each clock, by register and field: `apb1enr`, `tim2en`.
fn clock_bits(registers: &str) -> BTreeMap<(String, String), u32> {
    let mut bits = BTreeMap::new();
    for set in registers.split("        FieldSet {").skip(1) {
        let Some(register) = between(set, "name: \"", "\"") else { continue };
        for field in set.split("Field {").skip(1) {
            let name = between(field, "name: \"", "\"");
            let offset = field.split_once("RegularBitOffset {").map(|(_, rest)| rest);
            let offset = offset.and_then(|rest| between(rest, "offset: ", ",")?.parse().ok());
            if let (Some(name), Some(offset)) = (name, offset) {
                bits.insert((register.to_lowercase(), name.to_lowercase()), offset);
            }
        }
    }
    bits
}

fn file(mcu: &Mcu, chips: &Path, bits: &BTreeMap<(String, String), u32>) -> Result<String> {
    let head = text(&chips.join(mcu.largest.to_lowercase()).join("metadata.rs"))?;
    let body = between(&head, "include!(\"../", "\"").context("a chip without facts")?;
    let body = text(&chips.join(body))?;
    let numbers = interrupts(&body);
    let mut printed = format!(
        "# Written by `cargo xtask mcus` from stm32-metapac 21.0.0; do not edit.\nparts = {:?}\nlargest = {:?}\n\
         idcode = {:#010X}\n",
        mcu.parts, mcu.largest, mcu.idcode
    );
    for (name, is_own) in memories() {
        let _ = writeln!(printed, "{name}_bytes = {}", bytes(&head, is_own));
    }
    printed.push_str("\n[units]\n");
    let mut requests: BTreeMap<&str, [Vec<String>; 8]> = BTreeMap::new();
    for peripheral in body.split("\n    Peripheral {").skip(1) {
        let peripheral = peripheral.split("\n    },").next().unwrap_or(peripheral);
        let name = between(peripheral, "name: \"", "\"").context("a peripheral without a name")?;
        if !mcu.without.contains(&name)
            && let Some(unit) = unit(name, peripheral, bits, &numbers)
        {
            let _ = writeln!(printed, "{name} = {{ {unit} }}");
        }
        for request in peripheral.split("PeripheralDmaChannel {").skip(1) {
            let channel = between(request, "channel: Some(\"", "\"");
            let number = between(request, "request: Some(", ")").and_then(|one| one.parse().ok());
            let signal = between(request, "signal: \"", "\"");
            let (Some(channel), Some(number), Some(signal)) = (channel, number, signal) else {
                continue;
            };
            let row: Option<&mut Vec<String>> =
                requests.entry(channel).or_default().get_mut::<usize>(number);
            row.context("a request beyond 7")?.push(format!("{name}_{signal}"));
        }
    }
    printed.push_str("\n# By number of the request.\n[requests]\n");
    for (channel, row) in requests {
        let _ = writeln!(printed, "{channel} = {row:?}");
    }
    Ok(printed)
}

/// Whether a region, by name and kind, belongs to a memory.
type IsOwn = fn(&str, &str) -> bool;

/// The memories: flash, those that the DMA reaches, and core-coupled memory.
fn memories() -> [(&'static str, IsOwn); 3] {
    [
        ("flash", |name, kind| kind == "Flash" && name != "OTP"),
        ("sram", |name, kind| kind == "Ram" && !name.starts_with("CCM")),
        ("ccm", |name, _| name.starts_with("CCM")),
    ]
}

/// The size of all regions of a memory in bytes.
fn bytes(head: &str, is_own: IsOwn) -> u64 {
    let regions = head.split("MemoryRegion {").skip(1).filter_map(|region| {
        let name = between(region, "name: \"", "\"")?;
        let kind = between(region, "MemoryRegionKind::", ",")?;
        let size: u64 = between(region, "size: ", ",")?.parse().ok()?;
        is_own(name, kind).then_some(size)
    });
    regions.sum()
}

fn interrupts(body: &str) -> BTreeMap<String, u16> {
    let list = body.split_once("INTERRUPTS: &[Interrupt]").map_or("", |(_, rest)| rest);
    let list = list.split_once("\n];").map_or(list, |(list, _)| list);
    let one = |text: &str| {
        let name = between(text, "name: \"", "\"")?;
        let number = text.split_once("number: ")?.1;
        let number: String = number.chars().take_while(char::is_ascii_digit).collect();
        Some((name.to_owned(), number.parse().ok()?))
    };
    list.split("Interrupt {").skip(1).filter_map(one).collect()
}

fn unit(
    name: &str,
    source: &str,
    bits: &BTreeMap<(String, String), u32>,
    numbers: &BTreeMap<String, u16>,
) -> Option<String> {
    let base = between(source, "address: ", ",")?;
    let kind = between(source, "kind: \"", "\"")?;
    let version = between(source, "version: \"", "\"")?;
    let mut text = format!("block = \"{kind}_{version}\", base = {base}");
    let enable = source.split_once("enable: Some(").map(|(_, rest)| rest);
    // RTC: the other MCUs of the family have no such bit.
    if let Some(enable) = enable.filter(|_| name != "RTC") {
        let register = between(enable, "register: \"", "\"")?;
        let field = between(enable, "field: \"", "\"")?;
        let (_, offset) = ENABLES.iter().find(|(own, _)| *own == register)?;
        let bit = bits.get(&(register.to_lowercase(), field.to_lowercase()))?;
        let _ = write!(text, ", clock = [{offset:#04x}, {bit}]");
    }
    let mut irqs: BTreeMap<&str, u16> = BTreeMap::new();
    for one in source.split("PeripheralInterrupt {").skip(1) {
        let signal = between(one, "signal: \"", "\"")?;
        irqs.insert(signal, *numbers.get(between(one, "interrupt: \"", "\"")?)?);
    }
    if !irqs.is_empty() {
        let all: Vec<String> =
            irqs.iter().map(|(signal, irq)| format!("{signal} = {irq}")).collect();
        let _ = write!(text, ", irqs = {{ {} }}", all.join(", "));
    }
    Some(text)
}
