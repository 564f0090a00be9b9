//! `cargo xtask mcus [--check]`: writes the facts that the emulated machine needs about each MCU, or compares them.
//!
//! In: the metadata of the crate `stm32-metapac`, and [`MCUS`], which has the facts that they lack. Out: a file for
//! each MCU in `crates/machine/mcus/`. It gives the core and the memories; block, version, address, clock and
//! interrupts of each unit, the field that selects its kernel clock, and the field that moves its signals to other
//! pads; and the units that use each channel of the DMA, or each request of its multiplexer.

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
    core: &'static str,
    /// The MCU's identifier in the debug unit: `DBGMCU_IDCODE` in the reference manual.
    idcode: u32,
    /// The address of the half-word that has the size of the flash in kibibytes.
    size_at: u32,
    /// Whether pads are analog after a reset, and not inputs.
    starts_analog: bool,
    /// The units for which the machine's model of their version is not correct.
    without: &'static [&'static str],
}

/// What the lines of STM32F4 have in common.
const F4: Mcu = Mcu {
    parts: &[],
    largest: "",
    core: "cortex-m4f",
    idcode: 0,
    size_at: 0x1FFF_7A22,
    starts_analog: false,
    without: &[],
};

const MCUS: [Mcu; 8] = [
    // Medium density.
    Mcu {
        parts: &[
            "STM32F103C8",
            "STM32F103CB",
            "STM32F103R8",
            "STM32F103RB",
            "STM32F103T8",
            "STM32F103TB",
            "STM32F103V8",
            "STM32F103VB",
        ],
        largest: "STM32F103VB",
        core: "cortex-m3",
        idcode: 0x2003_6410,
        size_at: 0x1FFF_F7E0,
        starts_analog: false,
        without: &[],
    },
    Mcu { parts: &["STM32F401"], largest: "STM32F401VE", idcode: 0x1000_6433, ..F4 },
    Mcu {
        parts: &["STM32F405", "STM32F407", "STM32F415", "STM32F417"],
        largest: "STM32F407IG",
        idcode: 0x100F_6413,
        ..F4
    },
    Mcu { parts: &["STM32F411"], largest: "STM32F411VE", idcode: 0x1000_6431, ..F4 },
    // Its USB unit senses the bus in a different way.
    Mcu {
        parts: &["STM32F412"],
        largest: "STM32F412ZG",
        idcode: 0x3000_6441,
        without: &["USB_OTG_FS"],
        ..F4
    },
    Mcu {
        parts: &["STM32F427", "STM32F429", "STM32F437", "STM32F439"],
        largest: "STM32F429NI",
        idcode: 0x2003_6419,
        ..F4
    },
    // Its USB unit senses the bus in a different way.
    Mcu {
        parts: &["STM32F446"],
        largest: "STM32F446ZE",
        idcode: 0x1000_6421,
        without: &["USB_OTG_FS"],
        ..F4
    },
    // Category 3.
    Mcu {
        parts: &["STM32G473", "STM32G474", "STM32G483", "STM32G484"],
        largest: "STM32G474QE",
        core: "cortex-m4f",
        idcode: 0x2003_6469,
        size_at: 0x1FFF_75E0,
        starts_analog: true,
        without: &[],
    },
];

/// The kinds of units whose model takes the clock that the program selects for them.
const SELECTING: [&str; 4] = ["adc", "can", "i2c", "usart"];

/// Runs the command.
pub(crate) fn run(arguments: &[String]) -> Result<()> {
    let is_check = match arguments {
        [] => false,
        [one] if one == "--check" => true,
        _ => bail!(USAGE),
    };
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let chips = sources::fetch(&root)?.metapac;
    let folder = root.join("crates/machine/mcus");
    std::fs::create_dir_all(&folder)?;
    let embeds = text(&root.join("crates/machine/src/mcu.rs"))?;
    let mut stale = Vec::new();
    for mcu in &MCUS {
        let printed = file(mcu, &chips).with_context(|| mcu.largest)?;
        let name = mcu.parts.first().context("no parts")?.to_lowercase();
        let path = folder.join(format!("{name}.toml"));
        ensure!(embeds.contains(&format!("mcus/{name}.toml")), "mcu.rs does not embed {name}.toml");
        if !sources::is_fresh(&path, &printed, is_check)? {
            stale.push(name);
        }
    }
    ensure!(stale.is_empty(), "not as they would be written: {}", stale.join(", "));
    crate::say(&format!("{} MCUs\n", MCUS.len()))
}

/// The fields of a block's registers, by register and field: `apb1enr`, `tim2en`.
type Fields = BTreeMap<(String, String), Field>;

struct Field {
    /// The offset of its register.
    register: u32,
    bit: u32,
    bits: u32,
    /// The names of its values, in order; empty where they have none.
    values: Vec<String>,
}

/// The fields in a file of registers.
fn fields(registers: &str) -> Fields {
    let mut offsets: BTreeMap<String, u32> = BTreeMap::new();
    for item in registers.split("BlockItem {").skip(1) {
        let name = between(item, "name: \"", "\"");
        let offset = between(item, "byte_offset: 0x", ",");
        if let (Some(name), Some(offset)) = (name, offset) {
            offsets.extend(u32::from_str_radix(offset, 16).map(|offset| (name.to_owned(), offset)));
        }
    }
    let values = values(registers);
    let mut fields = Fields::new();
    for set in registers.split("        FieldSet {").skip(1) {
        let Some(register) = between(set, "name: \"", "\"").map(str::to_lowercase) else {
            continue;
        };
        let Some(offset) = offsets.get(&register) else { continue };
        for field in set.split("Field {").skip(1) {
            let place = field.split_once("RegularBitOffset {").map(|(_, rest)| rest);
            let bit = place.and_then(|rest| number_after(rest, "offset: "));
            let bits = place.and_then(|rest| number_after(rest, "bit_size: "));
            let name = between(field, "name: \"", "\"");
            if let (Some(name), Some(bit), Some(bits)) = (name, bit, bits) {
                let named =
                    between(field, "enumm: Some(\"", "\"").and_then(|name| values.get(name));
                let values = named.cloned().unwrap_or_default();
                let own = Field { register: *offset, bit, bits, values };
                fields.insert((register.clone(), name.to_lowercase()), own);
            }
        }
    }
    fields
}

/// The names of the values of each enumeration, in order.
fn values(registers: &str) -> BTreeMap<&str, Vec<String>> {
    let one = |source: &'_ str| -> Option<Vec<String>> {
        let mut values = Vec::new();
        for variant in source.split("EnumVariant {").skip(1) {
            let at = usize::try_from(number_after(variant, "value: ")?).ok()?;
            values.resize_with(values.len().max(at + 1), String::new);
            between(variant, "name: \"", "\"")?.clone_into(values.get_mut(at)?);
        }
        Some(values)
    };
    let enumerations = registers.split("        Enum {").skip(1);
    enumerations
        .filter_map(|source| Some((between(source, "name: \"", "\"")?, one(source)?)))
        .collect()
}

fn number_after(text: &str, start: &str) -> Option<u32> {
    let (_, number) = text.split_once(start)?;
    let digits: String = number.chars().take_while(char::is_ascii_digit).collect();
    digits.parse().ok()
}

/// The facts that the units of a chip share.
struct Chip {
    interrupts: BTreeMap<String, u16>,
    /// The fields of its RCC, and of the unit that moves signals to other pads, if it has one.
    rcc: Fields,
    afio: Fields,
}

impl Chip {
    fn read(body: &str, chips: &Path) -> Result<Self> {
        let registers = |unit: &str| {
            let source = body
                .split("\n    Peripheral {")
                .find(|one| between(one, "name: \"", "\"") == Some(unit));
            let version = source.and_then(|source| between(source, "version: \"", "\""));
            let Some(version) = version else { return Ok(Fields::new()) };
            let file = format!("../registers/{}_{version}.rs", unit.to_lowercase());
            anyhow::Ok(fields(&text(&chips.join(file))?))
        };
        let (rcc, afio) = (registers("RCC")?, registers("AFIO")?);
        Ok(Self { interrupts: interrupts(body), rcc, afio })
    }
}

fn file(mcu: &Mcu, chips: &Path) -> Result<String> {
    let head = text(&chips.join(mcu.largest.to_lowercase()).join("metadata.rs"))?;
    let body = between(&head, "include!(\"../", "\"").context("a chip without facts")?;
    let body = text(&chips.join(body))?;
    let chip = Chip::read(&body, chips)?;
    let mut printed = format!(
        "# Written by `cargo xtask mcus` from stm32-metapac 21.0.0; do not edit.\nparts = {:?}\nlargest = {:?}\n\
         core = {:?}\nidcode = {:#010X}\nsize_at = {:#010X}\n",
        mcu.parts, mcu.largest, mcu.core, mcu.idcode, mcu.size_at
    );
    for (name, is_own) in memories() {
        let _ = writeln!(printed, "{name}_bytes = {}", bytes(&head, is_own));
    }
    if head.contains(CCM_IN_SRAM) {
        printed.push_str("ccm_in_sram = true\n");
    }
    if mcu.starts_analog {
        printed.push_str("starts_analog = true\n");
    }
    printed.push_str("\n[units]\n");
    let mut requests: BTreeMap<&str, Vec<Vec<String>>> = BTreeMap::new();
    for peripheral in body.split("\n    Peripheral {").skip(1) {
        let peripheral = peripheral.split("\n    },").next().unwrap_or(peripheral);
        let name = between(peripheral, "name: \"", "\"").context("a peripheral without a name")?;
        if !mcu.without.contains(&name)
            && let Some(unit) = unit(name, peripheral, &chip)
        {
            let _ = writeln!(printed, "{name} = {{ {unit} }}");
        }
        for request in peripheral.split("PeripheralDmaChannel {").skip(1) {
            let channel = between(request, "channel: Some(\"", "\"");
            let multiplexer = between(request, "dmamux: Some(\"", "\"");
            let signal = between(request, "signal: \"", "\"");
            let (Some(place), Some(signal)) = (channel.or(multiplexer), signal) else { continue };
            // A channel without numbers serves all its requests, as if they had one.
            let number = between(request, "request: Some(", ")");
            let number: usize = number.map_or(Ok(0), str::parse)?;
            let rows = requests.entry(place).or_default();
            let length = match between(request, "request: ", ",") {
                _ if channel.is_none() => number + 1,
                Some("None") => 1,
                _ => 8,
            };
            ensure!(number < length, "a request beyond {length}");
            rows.resize_with(rows.len().max(length), Vec::new);
            rows.get_mut(number).context("a missing row")?.push(format!("{name}_{signal}"));
        }
    }
    printed.push_str("\n# By number of the request.\n[requests]\n");
    for (place, row) in requests {
        let _ = writeln!(printed, "{place} = {row:?}");
    }
    let multiplexed = multiplexed(&body);
    if !multiplexed.is_empty() {
        printed.push_str("\n# The multiplexer's channel for each stream.\n[multiplexed]\n");
    }
    for (stream, channel) in multiplexed {
        let _ = writeln!(printed, "{stream} = {channel}");
    }
    Ok(printed)
}

/// The streams whose requests a multiplexer selects, with its channel for each of them.
fn multiplexed(body: &str) -> Vec<(&str, u32)> {
    let streams = body.split_once("DMA_CHANNELS: ").map_or("", |(_, rest)| rest);
    let one = |stream| {
        let channel = number_after(stream, "dmamux_channel: Some(")?;
        Some((between(stream, "name: \"", "\"")?, channel))
    };
    streams.split("    DmaChannel {").skip(1).filter_map(one).collect()
}

/// Whether a region, by name and kind, belongs to a memory.
type IsOwn = fn(&str, &str) -> bool;

/// The region where the core-coupled memory is a second time, behind the memories that the DMA reaches.
const CCM_IN_SRAM: &str = "CCMRAM_DCODE";

/// The memories: flash, those that the DMA reaches, and core-coupled memory.
fn memories() -> [(&'static str, IsOwn); 3] {
    [
        ("flash", |name, kind| kind == "Flash" && name != "OTP"),
        ("sram", |name, kind| kind == "Ram" && (!name.starts_with("CCM") || name == CCM_IN_SRAM)),
        ("ccm", |name, _| name.starts_with("CCM") && name != CCM_IN_SRAM),
    ]
}

/// The size of all regions of a memory in bytes. A chip whose flash is one bank or two has a list of regions for each
/// case.
fn bytes(head: &str, is_own: IsOwn) -> u64 {
    let lists = head.split_once("memory: &[").map_or("", |(_, rest)| rest);
    let list = lists.split("&[").nth(1).unwrap_or(lists);
    let regions = list.split("MemoryRegion {").skip(1).filter_map(|region| {
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

/// The field that a place of the data names.
fn field<'a>(fields: &'a Fields, place: &str) -> Option<&'a Field> {
    let register = between(place, "register: \"", "\"")?.to_lowercase();
    let field = between(place, "field: \"", "\"")?.to_lowercase();
    fields.get(&(register, field))
}

fn unit(name: &str, source: &str, chip: &Chip) -> Option<String> {
    let base = between(source, "address: ", ",")?;
    let kind = between(source, "kind: \"", "\"")?;
    let version = between(source, "version: \"", "\"")?;
    let mut text = format!("block = \"{kind}_{version}\", base = {base}");
    // How many channels a timer has, and of which width.
    if kind == "timer" {
        let _ = write!(text, ", shape = \"{}\"", between(source, "block: \"", "\"")?);
    }
    let enable = source.split_once("enable: Some(").map(|(_, rest)| rest);
    // RTC: the other MCUs of the family have no such bit.
    if let Some(enable) = enable.filter(|_| name != "RTC") {
        let Field { register, bit, .. } = field(&chip.rcc, enable)?;
        let _ = write!(text, ", clock = [{register:#04x}, {bit}]");
    }
    let selected = source.split_once("kernel_clock: Mux(").map(|(_, rest)| rest);
    if let Some(selected) = selected.filter(|_| SELECTING.contains(&kind)) {
        let Field { register, bit, bits, values } = field(&chip.rcc, selected)?;
        let _ = write!(
            text,
            ", kernel = {{ field = [{register:#04x}, {bit}, {bits}], clocks = {values:?} }}"
        );
    }
    if let Some((_, moved)) = source.split_once("afio: Some(") {
        let Field { register, bit, bits, .. } = field(&chip.afio, moved)?;
        let _ = write!(text, ", remap = [{register:#04x}, {bit}, {bits}]");
    }
    let mut irqs: BTreeMap<&str, u16> = BTreeMap::new();
    for one in source.split("PeripheralInterrupt {").skip(1) {
        let signal = between(one, "signal: \"", "\"")?;
        irqs.insert(signal, *chip.interrupts.get(between(one, "interrupt: \"", "\"")?)?);
    }
    if !irqs.is_empty() {
        let all: Vec<String> =
            irqs.iter().map(|(signal, irq)| format!("{signal} = {irq}")).collect();
        let _ = write!(text, ", irqs = {{ {} }}", all.join(", "));
    }
    Some(text)
}
