//! The file form of a target profile: TOML in, checked entries out.
//!
//! The entries of a file are the types of [`crate::profile`]; here is what only the file has
//! (lines, and which entry is for which line) and the checks that its data make sense.

use std::collections::BTreeSet;

use serde::Deserialize;

use super::types::{
    Adc, Adcs, Dac, Dacs, Debug, Drivers, Exti, I2cs, Kernel, Off, Sourced, TargetProfile, Timer,
    Tree, Unit, Usb,
};

/// A file of `targets/`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct File {
    target: String,
    family: String,
    line: Vec<Line>,
    tree: Tree,
    drivers: Drivers,
    kernel: Kernel,
    exti: Exti,
    debug: Debug,
    off: Off,
    timers: Sourced,
    #[serde(default)]
    timer: Vec<Timer>,
    adcs: Adcs,
    #[serde(default)]
    adc: Vec<Adc>,
    i2cs: I2cs,
    #[serde(default)]
    i2c: Vec<Unit>,
    spis: Sourced,
    #[serde(default)]
    spi: Vec<Unit>,
    serials: Sourced,
    #[serde(default)]
    serial: Vec<Unit>,
    cans: Sourced,
    #[serde(default)]
    can: Vec<Unit>,
    dacs: Dacs,
    #[serde(default)]
    dac: Vec<Dac>,
    #[serde(default)]
    usb: Vec<Usb>,
}

/// Parts with the same peripherals.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Line {
    pub(crate) name: String,
    pub(crate) parts: Vec<String>,
    pub(crate) gpio_ports: Vec<char>,
    pub(crate) source: String,
}

/// An entry of a file: it has a name, and is for all lines or for some.
pub(crate) trait Entry {
    fn name(&self) -> &str;
    fn lines(&self) -> &[String];
}

fn of_line<E: Entry>(entries: Vec<E>, line: &Line) -> Vec<E> {
    let fits = |entry: &E| entry.lines().is_empty() || entry.lines().contains(&line.name);
    entries.into_iter().filter(fits).collect()
}

impl File {
    /// Reads a file.
    pub(crate) fn parse(text: &str) -> Result<Self, String> {
        toml::from_str(text).map_err(|error| error.to_string())
    }

    /// The line of an MCU.
    pub(crate) fn line_of(&self, mcu: &str) -> Option<&Line> {
        self.line.iter().find(|line| line.parts.iter().any(|part| mcu.starts_with(part.as_str())))
    }

    /// What of the file is for one line.
    pub(crate) fn into_profile(self, line: &Line) -> TargetProfile {
        TargetProfile {
            name: self.target,
            family: self.family,
            line: line.name.clone(),
            parts: line.parts.clone(),
            gpio_ports: line.gpio_ports.clone(),
            tree: self.tree,
            drivers: self.drivers,
            kernel: self.kernel,
            exti: self.exti,
            debug: self.debug,
            off: self.off,
            timers: of_line(self.timer, line),
            adc: self.adcs,
            adcs: of_line(self.adc, line),
            i2c: self.i2cs,
            i2cs: of_line(self.i2c, line),
            spis: of_line(self.spi, line),
            serials: of_line(self.serial, line),
            cans: of_line(self.can, line),
            dac: self.dacs,
            dacs: of_line(self.dac, line),
            usbs: of_line(self.usb, line),
        }
    }

    /// What is wrong with the data; empty when all is well.
    pub(crate) fn problems(&self) -> Vec<String> {
        let mut problems = Vec::new();
        let known: BTreeSet<&str> = self.line.iter().map(|line| line.name.as_str()).collect();
        let mut entries: Vec<(&str, &[String])> = Vec::new();
        push(&mut entries, &self.timer);
        push(&mut entries, &self.adc);
        push(&mut entries, &self.i2c);
        push(&mut entries, &self.spi);
        push(&mut entries, &self.serial);
        push(&mut entries, &self.can);
        push(&mut entries, &self.dac);
        push(&mut entries, &self.usb);
        for line in &self.line {
            let mut names = BTreeSet::new();
            for (name, lines) in &entries {
                let fits = lines.is_empty() || lines.contains(&line.name);
                if fits && !names.insert(*name) {
                    problems.push(format!("{}: {name} stands twice", line.name));
                }
            }
            for timer in self.kernel.timers.iter().filter(|timer| !names.contains(timer.as_str())) {
                problems.push(format!("{}: kernel timer {timer} is unknown", line.name));
            }
        }
        for (name, lines) in &entries {
            for line in lines.iter().filter(|line| !known.contains(line.as_str())) {
                problems.push(format!("{name}: there is no line {line}"));
            }
        }
        problems.extend(
            self.sources()
                .filter(|source| source.is_empty())
                .map(|_| "a group has no source".to_owned()),
        );
        problems.extend(self.timer.iter().filter_map(Timer::problem));
        problems.extend(self.adc.iter().filter_map(Adc::problem));
        problems
    }

    fn sources(&self) -> impl Iterator<Item = &str> {
        let groups = [
            self.tree.source.as_str(),
            self.drivers.source.as_str(),
            self.kernel.source.as_str(),
            self.exti.source.as_str(),
            self.debug.source.as_str(),
            self.off.source.as_str(),
            self.timers.source.as_str(),
            self.adcs.source.as_str(),
            self.i2cs.source.as_str(),
            self.spis.source.as_str(),
            self.serials.source.as_str(),
            self.cans.source.as_str(),
            self.dacs.source.as_str(),
        ];
        let lines = self.line.iter().map(|line| line.source.as_str());
        groups.into_iter().chain(lines).chain(self.usb.iter().map(|usb| usb.source.as_str()))
    }
}

fn push<'a, E: Entry>(all: &mut Vec<(&'a str, &'a [String])>, entries: &'a [E]) {
    all.extend(entries.iter().map(|entry| (entry.name(), entry.lines())));
}
