//! The MCU that a project names in; the pins of the whole part, and what its usual target can drive, out.
//!
//! A project uses some pins of its MCU. Whoever adds a device needs the others, with all usages.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet};

use sensedsl_board::mcu::normalise;
use sensedsl_board::pin::PinName;
use sensedsl_board::profile::{self, Target, TargetProfile};
use sensedsl_board::remap::Blocks;
use sensedsl_board::signal::{Function, Signal, TimerLine};
use sensedsl_board::silicon::{self, PinRole};
use sensedsl_diagnostics::Span;
use sensedsl_parts::{Part, Sheet};

use super::Project;
use crate::log::Log;

/// The least number of letters that say which line of MCUs is meant: `STM32G47`.
const LINE_LETTERS: usize = "STM32G47".len();

/// What is known of a project's MCU.
#[derive(Debug, Default)]
pub(crate) struct Chip {
    /// The part number for the table.
    pub(crate) mcu: Option<String>,
    /// The package, if the project tells it.
    pub(crate) package: Option<&'static str>,
    /// All pins of the part, if it is known.
    pub(crate) sheet: Option<Sheet>,
    /// What the target that is usual for the MCU can drive.
    pub(crate) profile: Option<Box<TargetProfile>>,
    /// The pins that the MCU needs for itself.
    roles: BTreeMap<PinName, PinRole>,
}

impl Chip {
    /// Finds the part of a project's MCU; reports what had to be guessed.
    pub(crate) fn of(project: &Project, whole: Span, log: &mut Log) -> Self {
        let Some(named) = project.mcu.as_deref() else {
            let what = "the source does not name the MCU: the table has no pins besides its own, \
                        and their usages follow once the table begins with `# mcu = …`";
            log.doubtful(whole, "", what);
            return Self::default();
        };
        let mut chip = Self { mcu: Some(named.to_owned()), ..Self::default() };
        let known = sensedsl_parts::find(named).filter(|found| !found.ambiguous);
        if let Some(found) = known {
            chip.package = found.package();
            chip.sheet = Some(found.sheet);
        } else if let Some((part, sheet)) = smallest(project, named) {
            let name = part.base();
            let what = format!(
                "{named} is made in several packages: the table has the pins of {name}, the \
                 smallest part with all pins in use. Name the part here if it is another"
            );
            log.doubtful(project.mcu_span.unwrap_or(whole), "", &what);
            chip.mcu = Some(name.to_owned());
            chip.sheet = Some(sheet);
        } else {
            let what = format!(
                "{named} is not among the known parts: the table has no pins besides those in use"
            );
            log.doubtful(project.mcu_span.unwrap_or(whole), "", &what);
        }
        let mcu = chip.mcu.as_deref().unwrap_or_default();
        if let Ok(Target::Profile(found)) = profile::find(profile::usual(mcu), mcu) {
            chip.roles.extend(found.debug.pins.iter().map(|pin| (pin.clone(), PinRole::Debug)));
            chip.profile = Some(found);
        }
        chip.roles.extend(silicon::pin_roles(mcu));
        chip.share_roles();
        chip
    }

    /// Pins on one contact of the package are needed together.
    fn share_roles(&mut self) {
        let Some(sheet) = &self.sheet else { return };
        let shared = sheet.shared();
        let at = |pin: &PinName| sheet.pin(pin)?.0.filter(|at| shared.contains(at));
        let needed: BTreeMap<&str, PinRole> = self
            .roles
            .iter()
            .filter(|(_, role)| **role != PinRole::Oscillator)
            .filter_map(|(pin, role)| Some((at(pin)?, *role)))
            .collect();
        let others = sheet
            .pins()
            .filter_map(|(pin, position, _)| Some((pin.clone(), *needed.get(position?)?)));
        let others: Vec<_> = others.filter(|(pin, _)| !self.roles.contains_key(pin)).collect();
        self.roles.extend(others);
    }

    /// The project with the part's names of its pins: in some packages, `PC2` is `PC2_C`.
    pub(crate) fn as_it_has_them(&self, project: &Project) -> Project {
        let mut project = project.clone();
        let Some(sheet) = &self.sheet else { return project };
        for wire in &mut project.wires {
            if sheet.pin(&wire.pin).is_none()
                && let Some(name) = switched(&wire.pin)
                && sheet.pin(&name).is_some()
            {
                wire.pin = name;
            }
        }
        project
    }

    /// What the MCU needs a pin for, so that a device gets it by `release` alone. On a bare part, a
    /// pin of the oscillator is one.
    pub(crate) fn needed_for(&self, pin: &PinName, is_bare: bool) -> Option<PinRole> {
        let role = self.roles.get(pin).copied();
        role.filter(|role| is_bare || *role != PinRole::Oscillator)
    }

    /// Whether the usual target has a driver for the function; also true without a target.
    pub(crate) fn drives(&self, function: &Function) -> bool {
        self.profile.as_ref().is_none_or(|profile| profile.serves(function))
    }

    /// Whether the usual target measures pulses on a channel of a timer.
    pub(crate) fn captures(&self, timer: &str, channel: u8) -> bool {
        let Some(profile) = &self.profile else { return channel <= 2 };
        let icu = profile.timer(timer).and_then(|timer| timer.icu.as_ref());
        icu.is_some_and(|icu| icu.channels.contains(&channel))
    }

    /// Whether the usual target decodes an encoder with a timer.
    pub(crate) fn decodes(&self, timer: &str) -> bool {
        let Some(profile) = &self.profile else { return true };
        profile.timer(timer).is_some_and(|timer| timer.encoder)
    }

    /// Whether the usual target puts pulses out of a channel of a timer, or of its inverted output.
    pub(crate) fn puts_out(&self, timer: &str, channel: u8, line: TimerLine) -> bool {
        let Some(profile) = &self.profile else { return line.is_output() };
        let Some(pwm) = profile.timer(timer).and_then(|timer| timer.pwm.as_ref()) else {
            return false;
        };
        match line {
            TimerLine::Both | TimerLine::Output => pwm.channels.contains(&channel),
            TimerLine::Inverted => pwm.complementary.contains(&channel),
            TimerLine::Input => false,
        }
    }

    /// Whether a pin has a function that the usual target has a driver for.
    pub(crate) fn can(&self, pin: &PinName, is_wanted: impl Fn(&Function) -> bool) -> bool {
        let Some((_, usages)) = self.sheet.as_ref().and_then(|sheet| sheet.pin(pin)) else {
            return false;
        };
        usages.iter().any(|(usage, _)| {
            let (signal, _) = Signal::parse(Blocks::split(usage).0);
            is_wanted(signal.function()) && self.drives(signal.function())
        })
    }

    /// Whether the usual target puts pulses out of a channel of a timer, not of its inverted output.
    pub(crate) fn is_output(&self, function: &Function) -> bool {
        let Function::Timer { unit, channel, line } = function else { return false };
        line.is_output() && self.puts_out(unit.as_str(), *channel, *line)
    }

    /// Whether pins besides those in use have signals of the unit.
    pub(crate) fn offers(&self, unit: &str) -> bool {
        let Some(sheet) = &self.sheet else { return false };
        let of_unit = |usage: &str| unit_of(usage).as_deref() == Some(unit);
        sheet.pins().flat_map(|(_, _, usages)| usages).any(|(usage, _)| of_unit(usage))
    }

    /// The part's serial port with wires on pins that are not taken, if there is one.
    pub(crate) fn free_serial(&self, pins: &BTreeSet<&PinName>, units: &BTreeSet<String>) -> bool {
        let (Some(profile), Some(sheet)) = (&self.profile, &self.sheet) else { return false };
        let free: Vec<(&PinName, Vec<&str>)> = sheet
            .pins()
            .filter(|(pin, _, _)| !pins.contains(pin) && !self.roles.contains_key(*pin))
            .map(|(pin, _, usages)| {
                (pin, usages.iter().map(|(usage, _)| Blocks::split(usage).0).collect())
            })
            .collect();
        let ends = |signal: &str| free.iter().any(|(_, usages)| usages.contains(&signal));
        profile.serials.iter().map(|unit| unit.name.as_str()).any(|unit| {
            !units.contains(unit) && ends(&format!("{unit}_TX")) && ends(&format!("{unit}_RX"))
        })
    }
}

/// The unit of a signal that belongs to one unit alone, as buses and timers do.
pub(crate) fn unit_of(spelled: &str) -> Option<String> {
    let (signal, _) = Signal::parse(Blocks::split(spelled).0);
    if signal.function().is_analog() {
        return None;
    }
    signal.function().units().first().map(|unit| unit.as_str().to_owned())
}

/// The converter's side of a pin with a switch: `PC2_C`.
fn switched(pin: &PinName) -> Option<PinName> {
    PinName::parse(&format!("{pin}_C"))
}

/// The parts that a line's name stands for: `STM32F405xx`, `STM32F103xB`.
fn parts_of(named: &str) -> impl Iterator<Item = Part> {
    let line = normalise(named).trim_end_matches('X').to_owned();
    let fits = move |part: &Part| {
        let base = part.base();
        let alike = |(a, b): (u8, u8)| a == b || b == b'X';
        let is_line = line.len() >= LINE_LETTERS && line.len() <= base.len();
        is_line && base.bytes().zip(line.bytes()).all(alike)
    };
    sensedsl_parts::all().filter(fits)
}

/// The pins of the part that a name stands for: of the one with the most pins, if it stands for
/// several.
pub(crate) fn widest(named: &str) -> Option<Sheet> {
    let exact = sensedsl_parts::find(named).filter(|found| !found.ambiguous);
    exact.map(|found| found.sheet).or_else(|| {
        let sheets = parts_of(named).map(Sheet::of);
        sheets.max_by_key(|sheet| sheet.pins().count())
    })
}

/// Of the parts that a line's name stands for (`STM32F405xx`, `STM32F103xB`), the one with all pins
/// in use, the project's flash and the fewest pins.
fn smallest(project: &Project, named: &str) -> Option<(Part, Sheet)> {
    let used: BTreeSet<&PinName> = project.wires.iter().map(|wire| &wire.pin).collect();
    parts_of(named)
        .map(|part| {
            let sheet = Sheet::of(part);
            let is_there = |pin: &PinName| sheet.pin(pin).is_some();
            let has = used
                .iter()
                .filter(|pin| is_there(pin) || switched(pin).is_some_and(|name| is_there(&name)))
                .count();
            let other = project.flash_bytes.is_some() && part.flash_bytes() != project.flash_bytes;
            ((Reverse(has), other, sheet.pins().count(), part.name()), (part, sheet))
        })
        .min_by(|(a, _), (b, _)| a.cmp(b))
        .map(|(_, found)| found)
}

/// The unit that a signal takes away from devices, also where it is none of their wires:
/// `USART1_RTS`, `TIM1_BKIN`; `I2S2_CK` is a signal of SPI2.
pub(crate) fn unit_taken_by(spelled: &str) -> Option<String> {
    const STEMS: [&str; 6] = ["TIM", "USART", "UART", "LPUART", "SPI", "I2C"];
    let numbered = || {
        let unit = spelled.split('_').next().unwrap_or_default();
        let stem = unit.trim_end_matches(|c: char| c.is_ascii_digit());
        let number = unit.get(stem.len()..).filter(|number| !number.is_empty())?;
        if stem == "I2S" {
            return Some(format!("SPI{number}"));
        }
        STEMS.contains(&stem).then(|| unit.to_owned())
    };
    unit_of(spelled).or_else(numbered)
}
