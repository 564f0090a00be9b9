//! From the chips of a family to the lines of its profile: chips with the same facts form a line.

use std::collections::{BTreeMap, BTreeSet};

use super::facts::Facts;
use super::metadata::{Body, Chip, Requests, Unit};

/// The lines of a family.
#[derive(Debug, Default)]
pub(crate) struct Lines {
    pub(crate) lines: Vec<Line>,
    /// The streams behind the multiplexers of the family's lines.
    pub(crate) kernel: Vec<String>,
}

/// Chips with the same facts.
#[derive(Debug)]
pub(crate) struct Line {
    pub(crate) name: String,
    pub(crate) parts: Vec<String>,
    /// Features of the HAL; one for a chip whose flash can be one bank or two is marked.
    pub(crate) chips: Vec<String>,
    pub(crate) facts: LineFacts,
    /// The index of the clock in the hand-kept facts.
    pub(crate) clock: Option<usize>,
}

/// The facts that distinguish one line from another. The facts of a unit are the text after the name in its entry.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct LineFacts {
    pub(crate) ports: String,
    /// The facts of the units, by group and name.
    pub(crate) units: BTreeMap<(Group, String), String>,
    pub(crate) left_out: BTreeSet<String>,
    /// The streams behind each multiplexer.
    pub(crate) multiplexers: BTreeMap<String, Vec<String>>,
    /// The interrupts that firmware binds, as entries.
    pub(crate) interrupts: BTreeMap<String, String>,
    /// The HAL's names for units that have other names here.
    pub(crate) peripherals: BTreeMap<String, String>,
    /// How the HAL selects the pins to which a unit is remapped: a `number` or a `switch`.
    pub(crate) remaps: BTreeMap<String, String>,
    /// The interrupts that nothing uses.
    pub(crate) spare: Vec<String>,
}

/// A group of a profile.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Group {
    Timers,
    Adcs,
    I2cs,
    Spis,
    Serials,
    Cans,
    Dacs,
    Usbs,
}

/// Interrupts of units that our firmware never turns on: they can run priority levels.
const SPARE: [&str; 8] = ["FLASH", "RCC", "PVD", "PVD_AVD", "PVD_PVM", "WWDG", "RNG", "HASH_RNG"];

/// The lines of a family, ordered by their first parts.
pub(crate) fn of(facts: &Facts, family: &str, chips: &[Chip]) -> Lines {
    let mut alike: BTreeMap<(LineFacts, Option<usize>), Vec<&Chip>> = BTreeMap::new();
    for chip in chips {
        let clock = facts.clock(&chip.name);
        let clock = clock.and_then(|one| facts.clock.iter().position(|it| std::ptr::eq(it, one)));
        alike.entry((facts_of(facts, family, &chip.body), clock)).or_default().push(chip);
    }
    let mut lines: Vec<Line> = Vec::new();
    for ((own, clock), members) in alike {
        let names: BTreeSet<&str> = members.iter().map(|chip| chip.name.as_str()).collect();
        let parts = prefixes(&names, chips);
        let mark = |chip: &&Chip| format!("{}{}", chip.feature, if chip.banks { "*" } else { "" });
        lines.push(Line {
            name: parts.first().cloned().unwrap_or_default(),
            parts,
            chips: members.iter().map(mark).collect(),
            facts: own,
            clock,
        });
    }
    lines.sort_by(|a, b| a.name.cmp(&b.name));
    Lines { kernel: kernel(facts, chips), lines }
}

/// The shortest prefixes of these names that no other chip of the family has.
fn prefixes(names: &BTreeSet<&str>, all: &[Chip]) -> Vec<String> {
    let mut found = BTreeSet::new();
    for name in names {
        let is_own = |start: &&str| {
            let alike = all.iter().filter(|chip| chip.name.starts_with(*start));
            alike.into_iter().all(|chip| names.contains(chip.name.as_str()))
        };
        let starts = (9..=name.len()).filter_map(|end| name.get(..end));
        found.insert(starts.into_iter().find(is_own).unwrap_or(name).to_owned());
    }
    found.into_iter().collect()
}

/// The timers whose interrupts belong to no other unit on any chip. Of other timers, capture and update interrupts count: no
/// code is generated for their brakes and triggers.
fn kernel(facts: &Facts, chips: &[Chip]) -> Vec<String> {
    let is_alone = |name: &&String| {
        chips.iter().all(|chip| {
            let Some(unit) = chip.body.units.get(*name) else { return true };
            let own =
                ["CC", "UP", "GLOBAL"].iter().filter_map(|signal| unit.interrupts.get(*signal));
            let others = chip.body.units.iter().filter(|(other, _)| other != name);
            let taken: BTreeSet<&String> =
                others.flat_map(|(other, unit)| taken(other, &unit.interrupts)).collect();
            own.into_iter().all(|interrupt| !taken.contains(interrupt))
        })
    };
    facts.kernel.iter().filter(is_alone).cloned().collect()
}

/// The interrupts of a unit that the firmware may have a handler for.
fn taken<'a>(
    unit: &str,
    interrupts: &'a BTreeMap<String, String>,
) -> impl Iterator<Item = &'a String> {
    let is_timer = unit.starts_with("TIM");
    let has_handler =
        move |signal: &String| !is_timer || matches!(signal.as_str(), "CC" | "GLOBAL" | "UP");
    interrupts.iter().filter(move |(signal, _)| has_handler(signal)).map(|(_, name)| name)
}

fn facts_of(facts: &Facts, family: &str, body: &Body) -> LineFacts {
    let mut own = LineFacts { ports: body.ports.iter().collect(), ..LineFacts::default() };
    for channel in &body.channels {
        let Some(stream) = stream(&channel.name) else { continue };
        let behind = channel.multiplexer.iter().chain([&channel.controller]);
        for name in behind {
            own.multiplexers.entry(name.clone()).or_default().push(stream.clone());
        }
        let unit = body.units.get(&channel.controller);
        let signal = channel.name.rsplit_once('_').map_or("", |(_, signal)| signal);
        let interrupt = unit.and_then(|unit| unit.interrupts.get(signal));
        own.interrupts
            .extend(interrupt.map(|one| (channel.name.clone(), format!("GLOBAL = \"{one}\""))));
    }
    for (name, unit) in &body.units {
        let Some((group, ours)) = place(family, name, unit) else { continue };
        let entry = match group {
            Group::Timers => timer(facts, unit),
            Group::Adcs => adc(facts, family, unit),
            Group::I2cs | Group::Spis => bus(unit, &own.multiplexers),
            Group::Serials => Some(clock(unit)),
            Group::Cans => Some(can(facts, family, unit)),
            Group::Dacs => Some(format!("outputs = {}", outputs(unit))),
            Group::Usbs => usb(facts, family, unit),
        };
        let Some(entry) = entry else {
            own.left_out.insert(ours);
            continue;
        };
        if ours != *name {
            own.peripherals.insert(ours.clone(), name.clone());
        }
        own.remaps.extend(unit.remap.clone().map(|field| (ours.clone(), field)));
        own.interrupts.extend(interrupts(unit).map(|all| (ours.clone(), all)));
        own.units.insert((group, ours), entry);
    }
    if let Some(exti) = body.units.get("EXTI") {
        let lines = exti.interrupts.iter().filter(|(signal, _)| signal.starts_with("EXTI"));
        own.interrupts
            .extend(lines.map(|(line, one)| (line.clone(), format!("GLOBAL = \"{one}\""))));
        // The metadata have no line for an interrupt that is shared with something else: `EXTI2_TSC` of F3.
        for line in (0..16).map(|number| format!("EXTI{number}")) {
            let shared = body.interrupts.iter().find(|name| name.starts_with(&format!("{line}_")));
            if let (None, Some(one)) = (exti.interrupts.get(&line), shared) {
                own.interrupts.insert(line, format!("GLOBAL = \"{one}\""));
            }
        }
    }
    own.multiplexers
        .retain(|name, _| own.units.values().any(|entry| entry.contains(&format!("\"{name}\""))));
    let is_there = |name: &&&str| body.interrupts.contains(**name);
    own.spare = SPARE.iter().filter(is_there).map(|name| (*name).to_owned()).collect();
    own
}

/// The group of a unit, and its name here.
fn place(family: &str, name: &str, unit: &Unit) -> Option<(Group, String)> {
    let is = |start: &str| {
        let rest = name.strip_prefix(start);
        rest.is_some_and(|rest| !rest.is_empty() && rest.bytes().all(|b| b.is_ascii_digit()))
    };
    let group = match unit.kind.as_str() {
        "timer" if is("TIM") && !unit.block.starts_with("TIM_BASIC") => Group::Timers,
        "adc" if is("ADC") => Group::Adcs,
        "i2c" if is("I2C") => Group::I2cs,
        "spi" if is("SPI") => Group::Spis,
        "usart" if is("USART") || is("UART") || is("LPUART") => Group::Serials,
        "can" if is("CAN") || is("FDCAN") => Group::Cans,
        "can" if name == "CAN" => return Some((Group::Cans, "CAN1".to_owned())),
        "dac" if is("DAC") => Group::Dacs,
        "usb" if name == "USB" => return Some((Group::Usbs, "USB1".to_owned())),
        "otg" => {
            let is_second = family == "STM32H7" && name == "USB_OTG_FS";
            return Some((Group::Usbs, if is_second { "OTG2" } else { "OTG1" }.to_owned()))
                .filter(|_| name == "USB_OTG_FS" || unit.pins.contains(&dm()));
        }
        _ => return None,
    };
    Some((group, name.to_owned()))
}

/// The data line that a full-speed device has on every part.
fn dm() -> (String, String) {
    ("DM".to_owned(), "PA11".to_owned())
}

/// The stream of a channel: `1,0` for `DMA1_CH0`; `None` for a controller that no driver here uses.
pub(crate) fn stream(channel: &str) -> Option<String> {
    let rest = channel.strip_prefix("GP").unwrap_or(channel).strip_prefix("DMA")?;
    let (controller, number) = rest.split_once("_CH")?;
    let (controller, number) = (controller.parse::<u8>().ok()?, number.parse::<u8>().ok()?);
    Some(format!("{controller},{number}"))
}

fn timer(facts: &Facts, unit: &Unit) -> Option<String> {
    let block = facts.blocks.get(&unit.block)?;
    let up_to = |last: u8| {
        let all: Vec<String> = (1..=last).map(|n| n.to_string()).collect();
        format!("[{}]", all.join(", "))
    };
    let clock = if unit.kernel_clock.is_empty() { &unit.bus_clock } else { &unit.kernel_clock };
    let mut entry = format!("bits = {}, clock = \"{clock}\"", block.bits);
    if block.channels >= 2 {
        entry.push_str(&format!(", icu = {}", up_to(2)));
    }
    entry.push_str(&format!(", pwm = {}", up_to(block.channels)));
    if block.complementary > 0 {
        entry.push_str(&format!(", complementary = {}", up_to(block.complementary)));
    }
    if block.encoder {
        entry.push_str(", encoder = true");
    }
    Some(entry)
}

fn adc(facts: &Facts, family: &str, unit: &Unit) -> Option<String> {
    let wanted = &facts.family.get(family)?.adc;
    // One driver serves two versions of F3's converters.
    let is_driven = unit.version == *wanted
        || (wanted == "v1" && family == "STM32L1" && unit.version == "f3v2");
    is_driven.then(String::new)
}

fn clock(unit: &Unit) -> String {
    let clock = if unit.kernel_clock.is_empty() { &unit.bus_clock } else { &unit.kernel_clock };
    format!("clock = \"{clock}\"")
}

/// The clock of a CAN controller. If it can be selected, the hand-kept facts give the selected one.
fn can(facts: &Facts, family: &str, unit: &Unit) -> String {
    let own = facts.family.get(family).and_then(|own| own.can.as_ref());
    own.map_or_else(|| clock(unit), |name| format!("clock = \"{name}\""))
}

/// The facts of a bus that moves its bytes by DMA in both directions.
fn bus(unit: &Unit, multiplexers: &BTreeMap<String, Vec<String>>) -> Option<String> {
    let of = |signal: &str| match unit.dma.get(signal)? {
        // A multiplexer for controllers that no driver here uses has no streams.
        Requests::Behind(name) => multiplexers.contains_key(name).then(|| format!("\"{name}\"")),
        Requests::Channels(list) => {
            let mut streams: Vec<String> = list.iter().filter_map(|one| stream(one)).collect();
            streams.dedup();
            (!streams.is_empty()).then(|| format!("[\"{}\"]", streams.join("\", \"")))
        }
    };
    Some(format!("{}, rx = {}, tx = {}", clock(unit), of("RX")?, of("TX")?))
}

fn outputs(unit: &Unit) -> usize {
    let has = |n: &usize| {
        let wanted = format!("OUT{n}");
        unit.pins.iter().any(|(signal, _)| *signal == wanted)
    };
    (1..=2).filter(has).count().max(1)
}

fn usb(facts: &Facts, family: &str, unit: &Unit) -> Option<String> {
    if !unit.pins.contains(&dm()) {
        return None;
    }
    let mut entry = "pins = [\"PA11\", \"PA12\"]".to_owned();
    let is_otg = unit.kind == "otg";
    if is_otg {
        entry.push_str(", vbus = \"PA9\"");
    }
    let excludes = &facts.family.get(family)?.excludes;
    if !excludes.is_empty() {
        entry.push_str(&format!(", excludes = [\"{}\"]", excludes.join("\", \"")));
    }
    entry.push_str(if is_otg { ", endpoints = 3" } else { ", endpoints = 7" });
    Some(entry)
}

/// The interrupts of a unit that a driver binds.
fn interrupts(unit: &Unit) -> Option<String> {
    let wanted: &[&str] = match unit.kind.as_str() {
        "i2c" => &["EV", "ER"],
        "usart" | "adc" | "otg" => &["GLOBAL"],
        "timer" => &["CC", "UP"],
        "usb" => &["LP"],
        "can" => &["TX", "RX0", "RX1", "SCE", "IT0", "IT1"],
        _ => return None,
    };
    let found = wanted.iter().filter_map(|signal| Some((signal, unit.interrupts.get(*signal)?)));
    let all: Vec<String> = found.map(|(signal, one)| format!("{signal} = \"{one}\"")).collect();
    (!all.is_empty()).then(|| all.join(", "))
}
