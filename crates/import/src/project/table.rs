//! A project's pins, its devices and its part in; the rows of the board table out: all pins of the
//! part, of which those that the project uses for something else are taken.

use std::collections::{BTreeMap, BTreeSet};

use sensedsl_board::pin::PinName;
use sensedsl_board::place::Place;
use sensedsl_board::remap::Blocks;
use sensedsl_board::signal::{Function, Signal};
use sensedsl_board::table::{Occupation, Onboard};

use super::chip::{Chip, unit_of};
use super::{Project, Wire};
use crate::assemble::Row;
use crate::devices::Inferred;

/// The rows, in no particular order.
pub(crate) fn rows(
    project: &Project,
    chip: &Chip,
    inferred: &Inferred,
    linked: Option<&str>,
) -> Vec<Row> {
    let used: BTreeSet<&PinName> = inferred.devices.iter().flat_map(|one| &one.pins).collect();
    let mut rows = whole_part(chip);
    for (pin, label) in &project.labels {
        let row = rows.entry(pin.clone()).or_insert_with(|| Row::new(pin.clone()));
        row.pin.label = Some(label.clone());
    }
    for wire in &project.wires {
        let row = rows.entry(wire.pin.clone()).or_insert_with(|| Row::new(wire.pin.clone()));
        if wire.label.is_some() {
            row.pin.label.clone_from(&wire.label);
        }
        let unit = wire.using.signal().and_then(unit_of);
        let is_linked = unit.is_some() && unit.as_deref() == linked;
        if let Some(unit) = unit.as_deref().filter(|unit| inferred.buses.contains(*unit)) {
            row.pin.onboard = Some(Onboard { part: unit.to_owned(), how: Occupation::Bus });
            row.usages.retain(|(usage, _)| unit_of(usage).as_deref() == Some(unit));
            serve(row, wire);
        } else if used.contains(&wire.pin) || is_linked {
            serve(row, wire);
        } else {
            taken(row, wire);
        }
    }
    if project.is_list {
        keep_listed(&mut rows, project);
    }
    let confined = inferred.buses.iter().map(String::as_str).chain(linked);
    confine(&mut rows, project, &confined.collect());
    rows.into_values().collect()
}

/// Leaves out the pins that a list of the board's pins does not have, if it is one and not only
/// names for a few of them.
fn keep_listed(rows: &mut BTreeMap<PinName, Row>, project: &Project) {
    let of_wires = project.wires.iter().map(|wire| &wire.pin);
    let listed: BTreeSet<&PinName> = project.labels.keys().chain(of_wires).collect();
    if listed.len() * 2 >= rows.len() {
        rows.retain(|pin, _| listed.contains(pin));
    }
}

/// All pins of the part with all usages.
fn whole_part(chip: &Chip) -> BTreeMap<PinName, Row> {
    let Some(sheet) = &chip.sheet else { return BTreeMap::new() };
    let shared = sheet.shared();
    let row = |(pin, position, usages): (&PinName, Option<&str>, &[sensedsl_parts::Usage])| {
        let mut row = Row::new(pin.clone());
        // Where the package is a guess, so are the positions, but not which pins share one.
        let known = |at: &&str| chip.package.is_some() || shared.contains(at);
        if let Some(position) = position.filter(known).map(str::to_owned) {
            row.pin.places.push(Place { position: Some(position), ..Place::default() });
        }
        row.usages.extend_from_slice(usages);
        (pin.clone(), row)
    };
    sheet.pins().map(row).collect()
}

/// Makes sure that the row has what the project uses the pin for.
fn serve(row: &mut Row, wire: &Wire) {
    let Some(signal) = wire.using.signal() else { return };
    let name = |spelled: &str| Signal::parse(Blocks::split(spelled).0).0;
    let wanted = name(signal);
    // Inputs of several converters are one usage.
    let is_input = |signal: &Signal| matches!(signal.function(), Function::Adc { .. });
    let has = |usage: &str| {
        let usage = name(usage);
        usage == wanted || is_input(&usage) && is_input(&wanted)
    };
    if !row.usages.iter().any(|(usage, _)| has(usage)) {
        row.usages.push((signal.to_owned(), None));
    }
}

/// Keeps the pin from devices.
fn taken(row: &mut Row, wire: &Wire) {
    let signal = wire.using.signal();
    let part = wire.label.as_deref().or(signal).unwrap_or("in use").replace(':', " ");
    row.pin.onboard = Some(Onboard { part, how: Occupation::Taken });
    row.pin.note = signal.map(str::to_owned);
}

/// Leaves the signals of the units only on the pins where the project has them, since the wires of
/// the board are there.
fn confine(rows: &mut BTreeMap<PinName, Row>, project: &Project, units: &BTreeSet<&str>) {
    let wired: BTreeSet<(&PinName, String)> = project
        .wires
        .iter()
        .filter_map(|wire| Some((&wire.pin, unit_of(wire.using.signal()?)?)))
        .collect();
    for (pin, row) in rows {
        row.usages.retain(|(usage, _)| {
            unit_of(usage)
                .is_none_or(|unit| !units.contains(unit.as_str()) || wired.contains(&(pin, unit)))
        });
    }
}
