//! The crate `stm32-metapac`: a chip's peripherals, DMA channels and interrupts from its generated sources.
//!
//! The sources are scanned as text, as for the table of parts: to compile them would take a build for each chip.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use anyhow::{Context as _, Result};

use crate::parts::metapac::between;
use crate::parts::sources::{entries, text};

/// A chip.
#[derive(Clone, Debug)]
pub(crate) struct Chip {
    /// The chip's name: `STM32F407VG`.
    pub(crate) name: String,
    /// The chip's family: `STM32F4`.
    pub(crate) family: String,
    /// The HAL's feature for it: `stm32f407vg`, `stm32h745zi-cm7`.
    pub(crate) feature: String,
    /// Whether its flash can be one bank or two, so that the HAL must be told which.
    pub(crate) banks: bool,
    pub(crate) body: Body,
}

/// The facts that chips with the same die share.
#[derive(Clone, Debug, Default)]
pub(crate) struct Body {
    pub(crate) units: BTreeMap<String, Unit>,
    pub(crate) ports: BTreeSet<char>,
    pub(crate) channels: Vec<Channel>,
    pub(crate) interrupts: BTreeSet<String>,
}

/// A peripheral.
#[derive(Clone, Debug, Default)]
pub(crate) struct Unit {
    pub(crate) kind: String,
    pub(crate) version: String,
    pub(crate) block: String,
    pub(crate) bus_clock: String,
    pub(crate) kernel_clock: String,
    /// Signals and pins.
    pub(crate) pins: BTreeSet<(String, String)>,
    /// The DMA channels of each signal.
    pub(crate) dma: BTreeMap<String, Requests>,
    /// The interrupt of each signal.
    pub(crate) interrupts: BTreeMap<String, String>,
    /// The field that remaps the unit to other pins.
    pub(crate) remap: Option<String>,
}

/// The possible destinations of a DMA request.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Requests {
    /// These channels.
    Channels(Vec<String>),
    /// All channels behind a multiplexer or in a controller.
    Behind(String),
}

/// A DMA channel.
#[derive(Clone, Debug)]
pub(crate) struct Channel {
    /// The channel's name: `DMA1_CH0`.
    pub(crate) name: String,
    /// Its controller.
    pub(crate) controller: String,
    /// Its multiplexer.
    pub(crate) multiplexer: Option<String>,
}

/// All chips by feature; for a chip with several cores, only the first one, which runs the firmware.
pub(crate) fn read(folder: &Path) -> Result<Vec<Chip>> {
    let mut bodies: BTreeMap<String, Body> = BTreeMap::new();
    let mut chips: Vec<Chip> = Vec::new();
    for path in entries(folder)?.into_iter().filter(|path| path.is_dir()) {
        let head = text(&path.join("metadata.rs"))?;
        let feature = path.file_name().map(|name| name.to_string_lossy().into_owned());
        let feature = feature.context("a folder without a name")?;
        if feature.ends_with("-cm4") && head.contains("STM32H7") || feature.ends_with("-cm0p") {
            continue;
        }
        let name = between(&head, "name: \"", "\"").context("a chip without a name")?.to_owned();
        let family = between(&head, "family: \"", "\"").context("no family")?.to_owned();
        let file = between(&head, "include!(\"../", "\"").context("a chip without facts")?;
        if !bodies.contains_key(file) {
            bodies.insert(file.to_owned(), body(&text(&folder.join(file))?)?);
        }
        let memory = between(&head, "memory: ", "peripherals: ").context("no memory")?;
        let banks = memory.matches("&[").count() > 2;
        let body = bodies.get(file).cloned().unwrap_or_default();
        chips.push(Chip { name, family, feature, banks, body });
    }
    Ok(chips)
}

fn body(source: &str) -> Result<Body> {
    let mut body = Body::default();
    for peripheral in source.split("\n    Peripheral {").skip(1) {
        let peripheral = peripheral.split("\n    },").next().unwrap_or(peripheral);
        let name = between(peripheral, "name: \"", "\"").context("a peripheral without a name")?;
        if let Some(port) = name.strip_prefix("GPIO").and_then(|port| port.chars().next()) {
            body.ports.insert(port);
        }
        body.units.insert(name.to_owned(), unit(peripheral));
    }
    for channel in source.split("\n    DmaChannel {").skip(1) {
        let name = between(channel, "name: \"", "\"").context("a channel without a name")?;
        let controller = between(channel, "dma: \"", "\"").context("no controller")?;
        body.channels.push(Channel {
            name: name.to_owned(),
            controller: controller.to_owned(),
            multiplexer: between(channel, "dmamux: ", ",").and_then(quoted),
        });
    }
    let list = source.split_once("INTERRUPTS: &[Interrupt]").map_or("", |(_, rest)| rest);
    let list = list.split_once("\n];").map_or(list, |(list, _)| list);
    for interrupt in list.split("Interrupt {").skip(1) {
        body.interrupts.extend(between(interrupt, "name: \"", "\"").map(str::to_owned));
    }
    Ok(body)
}

/// The text in `Some("…")`.
fn quoted(text: &str) -> Option<String> {
    between(text, "Some(\"", "\"").map(str::to_owned)
}

fn unit(source: &str) -> Unit {
    let field = |start: &str| between(source, start, "\"").unwrap_or_default().to_owned();
    let mut unit = Unit {
        kind: field("kind: \""),
        version: field("version: \""),
        block: field("block: \""),
        bus_clock: field("bus_clock: \""),
        kernel_clock: field("kernel_clock: Clock(\""),
        remap: source
            .split_once("afio: Some(")
            .and_then(|(_, afio)| between(afio, "field: \"", "\""))
            .map(str::to_owned),
        ..Unit::default()
    };
    for pin in source.split("PeripheralPin {").skip(1) {
        let of = |start: &str| between(pin, start, "\"").map(str::to_owned);
        unit.pins.extend(of("signal: \"").zip(of("pin: \"")));
    }
    for request in source.split("PeripheralDmaChannel {").skip(1) {
        let request = request.split_once('}').map_or(request, |(request, _)| request);
        let Some(signal) = between(request, "signal: \"", "\"") else { continue };
        let part = |start: &str| between(request, start, ",").and_then(quoted);
        if let Some(channel) = part("channel: ") {
            let known = unit.dma.entry(signal.to_owned());
            let known = known.or_insert_with(|| Requests::Channels(Vec::new()));
            if let Requests::Channels(list) = known {
                list.push(channel);
            }
        } else if let Some(all) = part("dmamux: ").or_else(|| part("dma: ")) {
            // The first one is common to all units of the family.
            unit.dma.entry(signal.to_owned()).or_insert(Requests::Behind(all));
        }
    }
    for one in source.split("PeripheralInterrupt {").skip(1) {
        let of = |start: &str| between(one, start, "\"").map(str::to_owned);
        unit.interrupts.extend(of("signal: \"").zip(of("interrupt: \"")));
    }
    unit
}

/// The sampling times of a converter version, in half cycles, ascending.
pub(crate) fn sampling(folder: &Path, version: &str) -> Result<Vec<u32>> {
    let source = text(&folder.join(format!("../registers/adc_{version}.rs")))?;
    let list = source.split_once("name: \"SampleTime\"").map_or("", |(_, rest)| rest);
    let list = list.split_once("\n        },\n        Enum").map_or(list, |(list, _)| list);
    let mut times: Vec<u32> = list
        .split("name: \"CYCLES")
        .skip(1)
        .filter_map(|name| {
            let name = name.split('"').next()?;
            let (whole, half) = name.split_once('_').unwrap_or((name, ""));
            Some(whole.parse::<u32>().ok()? * 2 + u32::from(half == "5"))
        })
        .collect();
    times.sort_unstable();
    times.dedup();
    Ok(times)
}

/// The one-bit fields that remap units to other pins.
pub(crate) fn switches(folder: &Path) -> Result<BTreeSet<String>> {
    let mut found = BTreeSet::new();
    for path in entries(&folder.join("../registers"))? {
        let is_afio =
            path.file_name().is_some_and(|name| name.to_string_lossy().starts_with("afio_"));
        if !is_afio {
            continue;
        }
        for field in text(&path)?.split("Field {").skip(1) {
            let name = between(field, "name: \"", "\"").unwrap_or_default();
            if between(field, "bit_size: ", ",") == Some("1") {
                found.insert(name.to_uppercase());
            }
        }
    }
    Ok(found)
}
