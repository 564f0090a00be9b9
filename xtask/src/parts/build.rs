//! The facts from all sources, joined and numbered.

use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};

use anyhow::{Context as _, Result, ensure};
use sensedsl_board::pin::natural;
use sensedsl_parts::format::{Data, Layout, PartData, Row};

use super::avr::Avr;
use super::esp::Esp;
use super::metapac::{Chip, Pins};
use super::modm::Device;
use super::nrf;
use super::sam::Sam;

/// The parts for which the source has the pinout of their variant with a voltage converter (`Q`), each with a part that
/// has the same pins in the same package according to the data sheets DS12737 and DS12736.
const REPLACED: [(&str, &str); 3] = [
    ("STM32L552QEI", "STM32L562QEI6"),
    ("STM32L552VET", "STM32L562VET6"),
    ("STM32L552ZET", "STM32L562ZET6"),
];

/// The parts for which the smaller of the two sums of RAM counts, according to the data sheets. `STM32F303xB`:
/// `modm-devices` has the RAM of the larger parts. STM32F413 and F423: it lists a block a second time, at the place
/// where other parts have core-coupled RAM. STM32H7R and H7S: `stm32-metapac` also counts a block in the memories of
/// the core, to which it can be assigned.
const SMALLER_RAM: [&str; 7] =
    ["STM32F303CB", "STM32F303RB", "STM32F303VB", "STM32F413", "STM32F423", "STM32H7R", "STM32H7S"];

/// The RAM in bytes of chips without a device file for which `stm32-metapac` differs from the data sheets DS14606 and
/// DS13543.
const RAM_BYTES: [(&str, usize); 2] = [("STM32WBA50KG", 64 << 10), ("STM32U5A5QI", 2512 << 10)];

/// The cores of families without device files, from their data sheets.
const CORES: [(&str, &str); 2] = [("STM32N6", "Cortex-M55"), ("STM32WBA", "Cortex-M33")];

/// A part, with names instead of numbers.
#[derive(Clone, Debug)]
struct Part<'a> {
    base: &'a str,
    codes: Vec<String>,
    pins: Cow<'a, Pins>,
    layout: Option<(&'a str, &'a [(String, String)])>,
    core: &'a str,
    flash_bytes: usize,
    ram_bytes: usize,
}

/// The parts of other vendors than ST.
pub(crate) struct Others {
    pub(crate) avrs: Vec<Avr>,
    pub(crate) esps: Vec<Esp>,
    pub(crate) nrfs: Vec<nrf::Part>,
    /// The pads of the only i.MX RT.
    pub(crate) imxrt: Pins,
    pub(crate) sams: Vec<Sam>,
}

/// The table, and figures for the person who makes it.
pub(crate) fn build(
    chips: &BTreeMap<String, Chip>,
    devices: &[Device],
    others: &Others,
) -> Result<(Data, String)> {
    let (mut parts, left_out) = stm32(chips, devices)?;
    parts.extend(others.parts());
    parts.sort_by(|a, b| (a.base, &a.codes).cmp(&(b.base, &b.codes)));

    let numbers: usize = parts.iter().map(|part| part.codes.len()).sum();
    let bare = parts.iter().filter(|part| part.layout.is_none()).count();
    let bases: BTreeSet<&str> = parts.iter().map(|part| part.base).collect();
    let data = number(&parts);
    let summary = format!(
        "{} parts of {} kinds with {numbers} part numbers; {bare} without packages; left out for \
         want of usages: {}\n{} rows, {} dies, {} layouts\n",
        parts.len(),
        bases.len(),
        left_out.join(" "),
        data.rows.len(),
        data.dies.len(),
        data.layouts.len(),
    );
    Ok((data, summary))
}

impl Others {
    fn parts(&self) -> Vec<Part<'_>> {
        let mut parts = Vec::new();
        for avr in &self.avrs {
            parts.extend(avr.variants.iter().map(|(code, (package, places))| Part {
                base: &avr.base,
                codes: vec![code.clone()],
                pins: Cow::Borrowed(&avr.pins),
                layout: Some((package.as_str(), places.as_slice())),
                core: &avr.core,
                flash_bytes: avr.flash_bytes,
                ram_bytes: avr.ram_bytes,
            }));
        }
        parts.extend(self.esps.iter().map(|esp| Part {
            base: esp.base,
            codes: vec![String::new()],
            pins: Cow::Borrowed(&esp.pins),
            layout: None,
            core: esp.core,
            flash_bytes: 0,
            ram_bytes: esp.ram_bytes,
        }));
        parts.extend(self.nrfs.iter().map(|nrf| Part {
            base: &nrf.base,
            codes: vec![nrf.code.clone()],
            pins: Cow::Borrowed(&nrf.pins),
            layout: nrf.layout.as_ref().map(|(package, places)| (package.as_str(), &places[..])),
            core: nrf.core,
            flash_bytes: nrf.flash_bytes,
            ram_bytes: nrf.ram_bytes,
        }));
        // RAM according to its data sheet: FlexRAM and OCRAM.
        parts.push(Part {
            base: "MIMXRT1062",
            codes: ["", "DVL6A", "DVJ6A"].map(str::to_owned).to_vec(),
            pins: Cow::Borrowed(&self.imxrt),
            layout: None,
            core: "Cortex-M7",
            flash_bytes: 0,
            ram_bytes: 1 << 20,
        });
        parts.extend(self.sams.iter().map(|sam| Part {
            base: &sam.base,
            codes: sam.codes.clone(),
            pins: Cow::Borrowed(&sam.pins),
            layout: None,
            core: sam.core,
            flash_bytes: sam.flash_bytes,
            ram_bytes: sam.ram_bytes,
        }));
        parts
    }
}

fn stm32<'a>(
    chips: &'a BTreeMap<String, Chip>,
    devices: &'a [Device],
) -> Result<(Vec<Part<'a>>, Vec<String>)> {
    let mut grouped: BTreeMap<(&str, &str, &str), Vec<&Device>> = BTreeMap::new();
    for device in devices {
        let key = (device.base.as_str(), device.package_code.as_str(), device.variant.as_str());
        grouped.entry(key).or_default().push(device);
    }
    let places = |device: &'a Device| -> &'a [(String, String)] {
        let plain = format!("{}{}", device.base, device.package_code);
        let other = REPLACED.iter().find(|(own, _)| device.variant.is_empty() && *own == plain);
        let other = other.and_then(|(_, other)| devices.iter().find(|d| d.number() == *other));
        &other.unwrap_or(device).places
    };
    let mut parts: Vec<Part<'_>> = Vec::new();
    let mut used = BTreeSet::new();
    let mut left_out = BTreeSet::new();
    for ((base, _, variant), group) in grouped {
        // Dies of another revision are separate chips: STM32L151CB-A.
        let names = [format!("{base}-{variant}"), base.to_owned()];
        let Some((name, chip)) = names.iter().find_map(|name| chips.get_key_value(name)) else {
            left_out.insert(base.get(..9).unwrap_or(base).to_owned());
            continue;
        };
        used.insert(name.as_str());
        // Grades of a part may differ in a pin: NRST and PF2 of some G0.
        let mut layouts: BTreeMap<&[(String, String)], Vec<&Device>> = BTreeMap::new();
        for device in group {
            layouts.entry(places(device)).or_default().push(device);
        }
        for (places, mut devices) in layouts {
            // The plainest grade, 6, comes first, then the others.
            devices.sort_by_key(|device| (device.grade != "6", &device.grade));
            let Some(first) = devices.first() else { continue };
            let code = |d: &&Device| format!("{}{}{}", d.package_code, d.grade, d.variant);
            parts.push(Part {
                base: &first.base,
                codes: devices.iter().map(code).collect(),
                pins: with_switches(&chip.pins, places),
                layout: Some((&first.package, places)),
                core: &first.core,
                flash_bytes: chip.flash_bytes,
                ram_bytes: ram_bytes(chip, first),
            });
        }
    }
    for (name, chip) in chips.iter().filter(|(name, _)| !used.contains(name.as_str())) {
        let corrected = RAM_BYTES.iter().find(|(of, _)| of == name);
        parts.push(Part {
            base: name,
            codes: vec![String::new()],
            pins: Cow::Borrowed(&chip.pins),
            layout: None,
            core: core_of(name, devices)?,
            flash_bytes: chip.flash_bytes,
            ram_bytes: corrected.map_or(chip.ram_bytes, |(_, bytes)| *bytes),
        });
    }
    Ok((parts, left_out.into_iter().collect()))
}

/// The size of the RAM. Both sources leave RAM out on some parts, so the larger sum counts.
fn ram_bytes(chip: &Chip, device: &Device) -> usize {
    let sums = [chip.ram_bytes, device.ram_bytes];
    let of_both = if SMALLER_RAM.iter().any(|start| device.base.starts_with(start)) {
        sums.into_iter().min()
    } else {
        sums.into_iter().max()
    };
    of_both.unwrap_or_default()
}

/// The core of a chip without a device file: the one that all devices of its line have.
fn core_of<'a>(chip: &str, devices: &'a [Device]) -> Result<&'a str> {
    if let Some((_, core)) = CORES.iter().find(|(family, _)| chip.starts_with(family)) {
        return Ok(core);
    }
    let line = chip.get(..9).unwrap_or(chip);
    let alike = devices.iter().filter(|device| device.base.starts_with(line));
    let cores: BTreeSet<&str> = alike.map(|device| device.core.as_str()).collect();
    ensure!(cores.len() == 1, "the core of {chip} is not known: {cores:?}");
    cores.first().copied().context("no core")
}

/// Adds the signals behind closed switches. On STM32H7, a pad such as `PC2_C` is connected to `PC2` by an analog
/// switch. If the package has no `PC2` of its own, the switch is closed after reset and the pad carries the signals of
/// both.
fn with_switches<'a>(pins: &'a Pins, places: &[(String, String)]) -> Cow<'a, Pins> {
    let has = |name: &str| places.iter().any(|(_, pin)| pin == name);
    let mut made = Cow::Borrowed(pins);
    for pad in places.iter().map(|(_, pin)| pin) {
        let Some(pin) = pad.strip_suffix("_C").filter(|pin| !has(pin)) else { continue };
        let usages = pins.get(pin).into_iter().flatten();
        // An input of the converter belongs to one pad or to the other.
        let digital = usages.filter(|(_, alternate)| alternate.is_some()).cloned();
        made.to_mut().entry(pad.clone()).or_default().extend(digital);
    }
    made
}

/// Names in natural order, and their numbers.
struct Names(Vec<String>);

impl Names {
    fn new<'a>(names: impl Iterator<Item = &'a str>) -> Self {
        let set: BTreeSet<&str> = names.collect();
        let mut names: Vec<String> = set.into_iter().map(str::to_owned).collect();
        names.sort_by(|a, b| natural(a, b).then_with(|| a.cmp(b)));
        Self(names)
    }

    fn of(&self, name: &str) -> usize {
        let order = |known: &String| natural(known, name).then_with(|| known.as_str().cmp(name));
        self.0.binary_search_by(order).unwrap_or_default()
    }
}

fn number(parts: &[Part<'_>]) -> Data {
    let places = || parts.iter().filter_map(|part| part.layout);
    let pins = || parts.iter().flat_map(|part| part.pins.as_ref());
    let on_packages = places().flat_map(|(_, places)| places).map(|(_, pin)| pin.as_str());
    let signals = Names::new(pins().flat_map(|(_, usages)| usages).map(|(name, _)| name.as_str()));
    let pin_names = Names::new(pins().map(|(pin, _)| pin.as_str()).chain(on_packages));
    let positions = Names::new(places().flat_map(|(_, p)| p).map(|(place, _)| place.as_str()));
    let packages = Names::new(places().map(|(package, _)| package));
    let cores = Names::new(parts.iter().map(|part| part.core));
    let codes = Names::new(parts.iter().flat_map(|part| &part.codes).map(String::as_str));
    let rows_of = |pins: &Pins| -> Vec<Row> {
        let row = |(pin, usages): (&String, &BTreeSet<(String, Option<u8>)>)| {
            let mut usages: Vec<_> =
                usages.iter().map(|(name, number)| (signals.of(name), *number)).collect();
            usages.sort_unstable();
            Row { pin: pin_names.of(pin), usages }
        };
        pins.iter().map(row).collect()
    };
    let layout_of = |(package, places): (&str, &[(String, String)])| Layout {
        package: packages.of(package),
        places: places.iter().map(|(at, pin)| (positions.of(at), pin_names.of(pin))).collect(),
    };
    let rows: BTreeSet<Row> = parts.iter().flat_map(|part| rows_of(&part.pins)).collect();
    let rows: Vec<Row> = rows.into_iter().collect();
    let die_of = |pins: &Pins| -> Vec<usize> {
        let mut die: Vec<usize> =
            rows_of(pins).iter().filter_map(|row| rows.binary_search(row).ok()).collect();
        die.sort_unstable();
        die
    };
    let dies: Vec<Vec<usize>> = {
        let set: BTreeSet<Vec<usize>> = parts.iter().map(|part| die_of(&part.pins)).collect();
        set.into_iter().collect()
    };
    let layouts: BTreeSet<Layout> = places().map(layout_of).collect();
    let layouts: Vec<Layout> = layouts.into_iter().collect();
    let numbered = parts.iter().map(|part| PartData {
        base: part.base.to_owned(),
        codes: part.codes.iter().map(|code| codes.of(code)).collect(),
        die: dies.binary_search(&die_of(&part.pins)).unwrap_or_default(),
        layout: part.layout.and_then(|layout| layouts.binary_search(&layout_of(layout)).ok()),
        core: cores.of(part.core),
        flash_bytes: part.flash_bytes,
        ram_bytes: part.ram_bytes,
    });
    Data {
        parts: numbered.collect(),
        signals: signals.0,
        pins: pin_names.0,
        positions: positions.0,
        packages: packages.0,
        codes: codes.0,
        cores: cores.0,
        rows,
        dies,
        layouts,
    }
}
