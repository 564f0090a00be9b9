//! A wiring for people to read in a terminal.

use std::fmt::Write as _;

use sensedsl_diagnostics::visible;
use sensedsl_model::design::Design;
use sensedsl_wiring::assignment::{Assignment, Neatness, SharedPin, Status};

use crate::rows::{Row, dividers, rows};

/// How parts of the table are highlighted; empty strings if there is no colour.
#[derive(Clone, Copy, Debug, Default)]
struct Style {
    head: &'static str,
    pin: &'static str,
    dim: &'static str,
    good: &'static str,
    reset: &'static str,
}

const COLOURED: Style = Style {
    head: "\u{1b}[1m",
    pin: "\u{1b}[1;36m",
    dim: "\u{1b}[2m",
    good: "\u{1b}[32m",
    reset: "\u{1b}[0m",
};

const HEAD: [&str; 7] = ["Device", "Role", "Pin", "Signal", "Unit", "Where", "Usages"];
/// The column that is highlighted, and the one that is right-aligned.
const PIN: usize = 2;
const USAGES: usize = 6;

/// The table, the totals and how good they are known to be.
#[must_use]
pub fn human(design: &Design, assignment: &Assignment, colour: bool) -> String {
    let style = if colour { COLOURED } else { Style::default() };
    let rows = rows(design, assignment);
    let mut out = String::new();
    for (on, board) in assignment.used(design) {
        let mcu = board.mcu.as_deref().unwrap_or("MCU unknown");
        let target = board.profile().map_or("pins only", |profile| profile.name.as_str());
        // Writing to a String cannot fail.
        let _ = writeln!(
            out,
            "{}{}{} {}({mcu}, {target}){}",
            style.head, board.name.value, style.reset, style.dim, style.reset
        );
        let mine: Vec<&Row> = rows.iter().filter(|row| row.board == board.name.value).collect();
        table(&mut out, &mine, style);
        for SharedPin { pin, with } in &on.shared {
            let Some(pin) = board.table.pins.get(*pin) else { continue };
            let _ = writeln!(out, "  {} is shared with {}", pin.name, visible(with));
        }
        for (device, divided) in dividers(design, on) {
            let _ = writeln!(out, "  {device}: {divided}");
        }
        if assignment.used(design).count() > 1 {
            let _ = writeln!(out, "  opportunity cost of this board: {}", on.cost);
        }
        out.push('\n');
    }
    totals(&mut out, design, assignment, style);
    out
}

fn table(out: &mut String, rows: &[&Row], style: Style) {
    let where_known = rows.iter().any(|row| !row.place.is_empty());
    let cells: Vec<[String; 7]> =
        rows.chunk_by(|one, next| one.device == next.device).flat_map(group).collect();
    let width = |column: usize| {
        let all = cells.iter().filter_map(|row| row.get(column)).map(|cell| cell.chars().count());
        all.chain(HEAD.get(column).map(|head| head.len())).max().unwrap_or_default()
    };
    let widths: Vec<usize> = (0..HEAD.len()).map(width).collect();
    line(out, &HEAD.map(String::from), &widths, where_known, (style.dim, style.dim), style.reset);
    for row in &cells {
        line(out, row, &widths, where_known, ("", style.pin), style.reset);
    }
}

/// The lines of one device, or of one chip with its values below its name.
fn group(rows: &[&Row]) -> Vec<[String; 7]> {
    let Some(first) = rows.first() else { return Vec::new() };
    let values = first.values.iter().map(|value| format!("  {value}"));
    let names: Vec<String> = [first.device.clone()].into_iter().chain(values).collect();
    let line = |at: usize| {
        let name = names.get(at).cloned().unwrap_or_default();
        let Some(row) = rows.get(at) else {
            return [name].into_iter().chain(std::iter::repeat_n(String::new(), 6)).collect();
        };
        let unit = if row.unit.is_empty() { "-" } else { &row.unit };
        vec![
            name,
            row.role.clone(),
            row.pin.clone(),
            visible(&row.signal).into_owned(),
            unit.to_owned(),
            visible(&row.place).into_owned(),
            row.usages.to_string(),
        ]
    };
    let lines = (0..rows.len().max(names.len())).map(line);
    lines.filter_map(|cells| cells.try_into().ok()).collect()
}

fn line(
    out: &mut String,
    cells: &[String; 7],
    widths: &[usize],
    where_known: bool,
    (plain, pin): (&str, &str),
    reset: &str,
) {
    let mut text = String::from(" ");
    for (column, (cell, width)) in cells.iter().zip(widths).enumerate() {
        if column == 5 && !where_known {
            continue;
        }
        let style = if column == PIN { pin } else { plain };
        let reset = if style.is_empty() { "" } else { reset };
        let padding = " ".repeat(width.saturating_sub(cell.chars().count()));
        let (before, after) =
            if column == USAGES { (padding.as_str(), "") } else { ("", padding.as_str()) };
        let _ = write!(text, " {before}{style}{cell}{reset}{after} ");
    }
    out.push_str(text.trim_end());
    out.push('\n');
}

fn totals(out: &mut String, design: &Design, assignment: &Assignment, style: Style) {
    let wires = rows(design, assignment);
    let mut pins: Vec<(&str, &str)> =
        wires.iter().map(|row| (row.board.as_str(), row.pin.as_str())).collect();
    pins.sort_unstable();
    pins.dedup();
    let devices = design.parts.len();
    let _ = write!(
        out,
        "{devices} {} on {} {}, opportunity cost {}{}{}",
        if devices == 1 { "device" } else { "devices" },
        pins.len(),
        if pins.len() == 1 { "pin" } else { "pins" },
        style.head,
        assignment.cost,
        style.reset,
    );
    match assignment.status {
        Status::Optimal => {
            let _ = write!(out, ", {}proved optimal{}", style.good, style.reset);
        }
        Status::Feasible if assignment.rise() > 0 => {
            let _ = write!(out, ", {} more than the cheapest, to be neater", assignment.rise());
        }
        Status::Feasible => match assignment.bound {
            Some(bound) => {
                let _ = write!(out, ", best so far (no wiring costs less than {})", bound.cost);
            }
            None => out.push_str(", valid (not compared with other wirings)"),
        },
    }
    if assignment.violated > 0 {
        let _ = write!(out, ", {} unmet wishes", assignment.violated);
    }
    if assignment.shared > 0 {
        let pins = if assignment.shared == 1 { "pin" } else { "pins" };
        let _ = write!(out, ", {} shared {pins}", assignment.shared);
    }
    if assignment.moved > 0 {
        let _ = write!(out, ", {} moved wires", assignment.moved);
    }
    out.push('\n');
    neatness(out, assignment);
}

/// How neat the wires are, if any of them is on a connector.
fn neatness(out: &mut String, assignment: &Assignment) {
    let Neatness { sides, span, is_proved, before, .. } = assignment.neatness;
    if sides == 0 {
        return;
    }
    let known = match (is_proved, before) {
        (true, _) => ", proved neatest",
        (false, Some(_)) => ", neat as found",
        (false, None) => "",
    };
    let noun = if sides == 1 { "side" } else { "sides" };
    let _ = writeln!(out, "{sides} connector {noun}, span {span}{known}");
}
