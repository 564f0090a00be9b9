//! A project in; a `.sense` file with its devices, its link and its rules, and the table of all pins
//! of its MCU, out.

use std::collections::{BTreeMap, BTreeSet};

use sensedsl_board::pin::PinName;
use sensedsl_diagnostics::Span;

use super::chip::{self, Chip};
use super::link::{self, Link};
use super::{Project, Wire, identifier, one_line, table};
use crate::assemble;
use crate::devices::{self, Inferred};
use crate::log::Log;
use crate::source::{Source, Texts};

/// Writes a project as a `.sense` file and its table.
pub(crate) fn made(project: &Project, source: &Source<'_>, whole: Span, log: &mut Log) -> Texts {
    let chip = Chip::of(project, whole, log);
    let project = &chip.as_it_has_them(project);
    let link = link::of(project, &chip, whole, log);
    let linked = link.as_ref().and_then(Link::unit);
    let inferred = devices::infer(project, &chip, linked, log);
    let rows = table::rows(project, &chip, &inferred, linked);
    // A table in which nothing is on any pin is that of a bare part, which may have a crystal.
    let is_bare = rows.iter().all(|row| row.pin.onboard.is_none());
    let mcu = chip.mcu.iter().map(|mcu| ("mcu", mcu.clone()));
    let package = chip.package.iter().map(|package| ("package", (*package).to_owned()));
    let properties: Vec<_> = mcu.chain(package).collect();
    let Some(table) = assemble::table(&properties, rows, whole, log) else {
        return Texts::default();
    };
    let rules = Rules::of(project, (&chip, is_bare), &inferred, linked);
    let program = program(project, &inferred, (link.as_ref(), &rules), source.table);
    Texts { table: Some(table.to_csv()), program: Some(program) }
}

/// The rules of the board.
struct Rules {
    /// Pins that devices and buses are on although the MCU needs them for itself, by what it needs them for.
    release: BTreeMap<&'static str, Vec<String>>,
    /// Units that the project uses for something that is not a device.
    reserve: Vec<String>,
}

impl Rules {
    fn of(
        project: &Project,
        (chip, is_bare): (&Chip, bool),
        inferred: &Inferred,
        linked: Option<&str>,
    ) -> Self {
        let standing = inferred.devices.iter().filter(|device| !device.open);
        let used: BTreeSet<&PinName> = standing.flat_map(|device| &device.pins).collect();
        // A bus keeps its pins although its devices are comments still.
        let is_kept = |wire: &&Wire| {
            let unit = wire.using.signal().and_then(chip::unit_of);
            let serves =
                |unit: &String| Some(unit.as_str()) == linked || inferred.buses.contains(unit);
            used.contains(&wire.pin) || unit.as_ref().is_some_and(serves)
        };
        let kept: BTreeSet<&PinName> =
            project.wires.iter().filter(is_kept).map(|wire| &wire.pin).collect();
        let mut release: BTreeMap<&'static str, Vec<String>> = BTreeMap::new();
        for pin in kept {
            if let Some(role) = chip.needed_for(pin, is_bare) {
                release.entry(role.describe()).or_default().push(pin.to_string());
            }
        }
        let is_free = |unit: &&String| chip.offers(unit) && Some(unit.as_str()) != linked;
        Self { release, reserve: inferred.reserved.iter().filter(is_free).cloned().collect() }
    }

    /// The statements, each with a comment that says why.
    fn lines(&self) -> Vec<String> {
        let release = self
            .release
            .iter()
            .map(|(role, pins)| format!("release {}; // otherwise for {role}", pins.join(", ")));
        let reserve = (!self.reserve.is_empty()).then(|| {
            format!("reserve {}; // in use for what is not a device", self.reserve.join(", "))
        });
        release.chain(reserve).collect()
    }
}

/// The text of the `.sense` file.
fn program(
    project: &Project,
    inferred: &Inferred,
    (link, rules): (Option<&Link>, &Rules),
    table: &str,
) -> String {
    let name = identifier(&project.name).unwrap_or_else(|| "Board".into());
    let mut text = format!("// The pins of {}, as they were.\n", one_line(&project.name));
    let table = table.replace(['"', '\\', '\n'], "_");
    text.push_str(&format!("board {name} on \"{table}\" {{\n"));
    if let Some(link) = link {
        let lines = link.lines().into_iter().map(|line| format!("        {line}\n"));
        text.push_str(&format!("    link {{\n{}    }}\n", lines.collect::<String>()));
    }
    for line in rules.lines() {
        text.push_str(&format!("    {line}\n"));
    }
    for device in &inferred.devices {
        let sign = if device.open { "    // " } else { "    " };
        let mut line = |line: &str| text.push_str(&format!("{sign}{line}\n"));
        line(&format!("{} {{", device.head));
        for property in &device.properties {
            line(&format!("    {property}"));
        }
        line("}");
    }
    text.push_str("}\n");
    text
}
