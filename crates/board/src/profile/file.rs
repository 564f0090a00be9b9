//! The file form of a target profile: TOML in, the facts of one line out.
//!
//! A file describes a family and states repeated facts only once: a line lists the units it has, a
//! group has the rules for a unit's driver, switch and options, and a multiplexer stands for all
//! the streams behind it. This module combines them into the types of [`crate::profile`].

use std::collections::{BTreeMap, BTreeSet};

use serde::Deserialize;

use super::entries::{
    AdcGroup, BusGroup, DacEntry, DacGroup, Entry, I2cGroup, PioGroup, SerialGroup, Streams,
    TimerGroup, UsbGroup,
};
use super::rates::Costs;
use super::types::{Debug, Edges, Exti, Kernel, Own, Stream, TargetProfile, Timer, all_pins};
use crate::pin::PinName;

/// A file of `targets/`.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct File {
    target: String,
    family: String,
    /// Units that the registry names but no line uses.
    #[serde(default)]
    left_out: String,
    line: Vec<Line>,
    kernel: Kernel,
    costs: Option<Costs>,
    exti: Exti,
    edges: Option<Edges>,
    debug: Debug,
    #[serde(default)]
    multiplexer: Vec<Multiplexer>,
    timers: TimerGroup,
    pios: Option<PioGroup>,
    adcs: AdcGroup,
    i2cs: I2cGroup,
    spis: BusGroup,
    serials: SerialGroup,
    cans: Option<BusGroup>,
    dacs: Option<DacGroup>,
    usbs: Option<UsbGroup>,
    /// Facts that only the system's own generator reads.
    #[serde(default)]
    system: toml::Table,
}

/// Parts with the same peripherals.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Line {
    pub(crate) name: String,
    /// Part-number prefixes; `?` stands for any character.
    pub(crate) parts: Vec<String>,
    /// The letters of the GPIO ports.
    pub(crate) gpio_ports: String,
    /// The names of the units, separated by white space.
    pub(crate) units: String,
    /// The pins whose edges can interrupt, separated by white space, if not all can.
    #[serde(default, deserialize_with = "all_pins")]
    pub(crate) interrupts: Option<Vec<PinName>>,
    /// Units that the registry names but the line does not use.
    #[serde(default)]
    pub(crate) left_out: String,
    /// Clocks, in hertz, that the system sets itself, whatever the board.
    #[serde(default)]
    pub(crate) clocks_hz: BTreeMap<String, u32>,
    /// Facts that only the system's own generator reads.
    #[serde(default)]
    pub(crate) system: toml::Table,
    pub(crate) source: String,
}

impl Line {
    /// Whether the line has a unit.
    pub(crate) fn has(&self, unit: &str) -> bool {
        self.units.split_whitespace().any(|name| name == unit)
    }

    /// Whether an entry applies to the line.
    fn wants(&self, entry: &(impl Entry + ?Sized)) -> bool {
        self.has(entry.name()) && self.fits(entry.lines())
    }

    fn fits(&self, lines: &[String]) -> bool {
        lines.is_empty() || lines.contains(&self.name)
    }
}

/// A multiplexer that connects any request to any of its streams.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Multiplexer {
    name: String,
    #[serde(default)]
    lines: Vec<String>,
    streams: Vec<Stream>,
    source: String,
}

/// Whether a name starts with a pattern, in which `?` stands for any character.
pub(crate) fn starts(name: &str, pattern: &str) -> bool {
    let alike = |(a, b): (u8, u8)| a == b || b == b'?';
    name.len() >= pattern.len() && name.bytes().zip(pattern.bytes()).all(alike)
}

/// The entries of a group that apply to the line.
fn of_line<E: Entry>(units: Vec<E>, line: &Line) -> impl Iterator<Item = E> {
    units.into_iter().filter(|unit| line.wants(unit))
}

impl File {
    /// Reads a file.
    pub(crate) fn parse(text: &str) -> Result<Self, String> {
        toml::from_str(text).map_err(|error| error.to_string())
    }

    /// The line of an MCU.
    pub(crate) fn line_of(&self, mcu: &str) -> Option<&Line> {
        self.line.iter().find(|line| line.parts.iter().any(|part| starts(mcu, part)))
    }

    /// The units that the registry names for a line but the profile deliberately leaves out.
    pub(crate) fn left_out<'a>(&'a self, line: &'a Line) -> impl Iterator<Item = &'a str> {
        self.left_out.split_whitespace().chain(line.left_out.split_whitespace())
    }

    /// All lines.
    pub(crate) fn lines(&self) -> &[Line] {
        &self.line
    }

    /// The profile of one line.
    pub(crate) fn into_profile(self, line: &Line) -> TargetProfile {
        let streams = |streams: Streams| match streams {
            Streams::Each(list) => list,
            Streams::Behind(name) => {
                let mut all = self.multiplexer.iter();
                let found = all.find(|mux| mux.name == name && line.fits(&mux.lines));
                found.map(|mux| mux.streams.clone()).unwrap_or_default()
            }
        };
        let TimerGroup { units, without_interrupt, source: _ } = self.timers;
        let timers = of_line(units, line).map(|unit| unit.timer(&without_interrupt));
        let timers: Vec<Timer> = timers.collect();
        let pios =
            self.pios.iter().flat_map(|group| group.units.iter().map(move |unit| (group, unit)));
        let pios = pios.filter(|(_, unit)| line.wants(*unit)).map(|(group, unit)| group.pio(unit));
        let pios = pios.collect();
        let mut kernel = self.kernel;
        kernel.timers.retain(|name| timers.iter().any(|timer| timer.name == *name));
        let (adc_rules, adc) = (self.adcs.rules, self.adcs.facts);
        let (i2c_rules, i2c) = (self.i2cs.rules, self.i2cs.facts);
        let buses = |group: BusGroup| -> Vec<_> {
            of_line(group.units, line).map(|unit| unit.unit(&group.rules, &streams)).collect()
        };
        let adcs = of_line(self.adcs.units, line).map(|unit| unit.adc(&adc_rules, &streams));
        let i2cs = of_line(self.i2cs.units, line).map(|unit| unit.unit(&i2c_rules, &streams));
        let (spi_dividers, serial_dividers) =
            (self.spis.dividers.clone(), self.serials.dividers.clone());
        let (dac, dacs) = self.dacs.map(|group| (group.facts, group.units)).unzip();
        let (source, usbs) = self.usbs.map(|group| (group.source, group.units)).unzip();
        let (dacs, usbs) = (dacs.unwrap_or_default(), usbs.unwrap_or_default());
        let source: String = source.unwrap_or_default();
        TargetProfile {
            name: self.target,
            family: self.family,
            line: line.name.clone(),
            parts: line.parts.clone(),
            gpio_ports: line.gpio_ports.chars().collect(),
            kernel,
            costs: self.costs,
            exti: self.exti,
            interrupts: line.interrupts.clone(),
            edges: self.edges,
            debug: self.debug,
            timers,
            pios,
            adc,
            adcs: adcs.collect(),
            i2c,
            i2cs: i2cs.collect(),
            spis: buses(self.spis),
            spi_dividers,
            serial_dividers,
            can_dividers: self.cans.as_ref().and_then(|group| group.dividers.clone()),
            serials: buses(self.serials),
            cans: self.cans.map(buses).unwrap_or_default(),
            dac,
            dacs: of_line(dacs, line).map(DacEntry::dac).collect(),
            usbs: of_line(usbs, line).map(|unit| unit.usb(&source)).collect(),
            clocks_hz: line.clocks_hz.clone(),
            own: Own { file: self.system, line: line.system.clone() },
        }
    }

    /// The mistakes in the data; empty if there are none.
    pub(crate) fn problems(&self) -> Vec<String> {
        let mut problems = Vec::new();
        let known: BTreeSet<&str> = self.line.iter().map(|line| line.name.as_str()).collect();
        let mut entries: Vec<(&str, &[String])> = Vec::new();
        push(&mut entries, &self.timers.units);
        push(&mut entries, self.pios.as_ref().map(|group| &group.units).into_iter().flatten());
        push(&mut entries, &self.adcs.units);
        push(&mut entries, &self.i2cs.units);
        push(&mut entries, &self.spis.units);
        push(&mut entries, &self.serials.units);
        push(&mut entries, self.cans.as_ref().map(|group| &group.units).into_iter().flatten());
        push(&mut entries, self.dacs.as_ref().map(|group| &group.units).into_iter().flatten());
        push(&mut entries, self.usbs.as_ref().map(|group| &group.units).into_iter().flatten());
        for name in &self.timers.without_interrupt {
            if !self.timers.units.iter().any(|timer| timer.name() == name) {
                problems.push(format!("{name} has no interrupt and is no timer"));
            }
        }
        for line in &self.line {
            for unit in line.units.split_whitespace() {
                let fits = |(name, lines): &&(&str, &[String])| *name == unit && line.fits(lines);
                let count = entries.iter().filter(fits).count();
                if count != 1 {
                    problems.push(format!("{}: {unit} stands {count} times", line.name));
                }
            }
            if line.parts.is_empty() || line.gpio_ports.is_empty() {
                problems.push(format!("{}: no parts or ports", line.name));
            }
        }
        for (name, lines) in &entries {
            for line in lines.iter().filter(|line| !known.contains(line.as_str())) {
                problems.push(format!("{name}: there is no line {line}"));
            }
            if !self.line.iter().any(|line| line.has(name) && line.fits(lines)) {
                problems.push(format!("{name} ({}): no line has it", lines.join(" ")));
            }
        }
        for line in &self.line {
            let named = self.multiplexers().filter(|(entry, _)| line.wants(*entry));
            for (_, mux) in named {
                let has = |known: &&Multiplexer| known.name == mux && line.fits(&known.lines);
                if self.multiplexer.iter().filter(has).count() != 1 {
                    problems.push(format!("{}: there is no one multiplexer {mux}", line.name));
                }
            }
        }
        let empty = self.sources().filter(|source| source.is_empty());
        problems.extend(empty.map(|_| "a group has no source".to_owned()));
        problems
    }

    /// The units that reach their streams through a multiplexer, with its name.
    fn multiplexers(&self) -> impl Iterator<Item = (&dyn Entry, &str)> {
        let adcs = self.adcs.units.iter().map(|unit| unit as &dyn Entry);
        let buses = self.i2cs.units.iter().chain(&self.spis.units);
        let all = adcs.chain(buses.map(|unit| unit as &dyn Entry));
        all.flat_map(|unit| unit.multiplexers().into_iter().map(move |name| (unit, name)))
    }

    fn sources(&self) -> impl Iterator<Item = &str> {
        let groups = [
            self.kernel.source.as_str(),
            self.exti.source.as_str(),
            self.debug.source.as_str(),
            self.timers.source.as_str(),
            self.adcs.facts.source.as_str(),
            self.i2cs.facts.source.as_str(),
            self.spis.source.as_str(),
            self.serials.source.as_str(),
        ];
        let lines = self.line.iter().map(|line| line.source.as_str());
        let optional = [
            self.cans.as_ref().map(|group| group.source.as_str()),
            self.dacs.as_ref().map(|group| group.facts.source.as_str()),
            self.usbs.as_ref().map(|group| group.source.as_str()),
            self.costs.as_ref().map(|costs| costs.source.as_str()),
            self.spis.dividers.as_ref().map(|dividers| dividers.source.as_str()),
            self.serials.dividers.as_ref().map(|dividers| dividers.source.as_str()),
            dividers_of(self.cans.as_ref()),
            self.pios.as_ref().map(|group| group.source.as_str()),
            self.edges.as_ref().map(|edges| edges.source.as_str()),
        ];
        let multiplexers = self.multiplexer.iter().map(|mux| mux.source.as_str());
        groups.into_iter().chain(lines).chain(optional.into_iter().flatten()).chain(multiplexers)
    }
}

fn dividers_of(group: Option<&BusGroup>) -> Option<&str> {
    Some(group?.dividers.as_ref()?.source.as_str())
}

fn push<'a, E: Entry + 'a>(
    all: &mut Vec<(&'a str, &'a [String])>,
    entries: impl IntoIterator<Item = &'a E>,
) {
    all.extend(entries.into_iter().map(|entry| (entry.name(), entry.lines())));
}
