//! The parts for a terminal of 80 columns.

use std::fmt::Write as _;

use sensedsl_model::facts::{PartFacts, example};
use sensedsl_wire::Direction;

use super::words::{self, wrapped};
use crate::contact::Wires;

/// Characters in a line.
const WIDTH: usize = 80;
/// Widest columns of the list: name, kinds, full name; the values take the rest.
const NAME_MAX: usize = 22;
const KIND_MAX: usize = 7;
const PART_MAX: usize = 23;
/// Width of the labels in front of facts.
const LABEL: usize = 12;

/// A table of parts, field by field.
#[must_use]
pub fn listing(parts: &[PartFacts]) -> String {
    let mut out = String::new();
    let widths = [NAME_MAX, KIND_MAX, PART_MAX, WIDTH - NAME_MAX - KIND_MAX - PART_MAX - 6];
    for (field, parts) in super::by_field(parts) {
        if !out.is_empty() {
            out.push('\n');
        }
        let _ = writeln!(out, "{field}");
        for part in parts {
            let name = format!("  {}", part.name);
            let cells = [name, words::kinds(part), part.part.clone(), words::values(part)];
            row(&mut out, &cells, widths);
        }
    }
    out
}

/// A row with as many lines as its cells need.
fn row<const N: usize>(out: &mut String, cells: &[String; N], widths: [usize; N]) {
    let mut columns: Vec<Vec<String>> = Vec::new();
    for (cell, width) in cells.iter().zip(widths) {
        // An indented cell keeps its indentation.
        let indent = if cell.starts_with(' ') { "  " } else { "" };
        let lines = wrapped(cell, width, indent, indent);
        columns.push(lines.lines().map(str::to_owned).collect());
    }
    let height = columns.iter().map(Vec::len).max().unwrap_or_default();
    for at in 0..height {
        let mut line = String::new();
        for (column, width) in columns.iter().zip(widths) {
            let cell = column.get(at).map(String::as_str).unwrap_or_default();
            let _ = write!(line, "{cell:width$}  ");
        }
        out.push_str(line.trim_end());
        out.push('\n');
    }
}

/// Everything about one part.
#[must_use]
pub fn one(part: &PartFacts) -> String {
    let mut out = wrapped(&format!("{}: {}", part.name, part.part), WIDTH, "", "  ");
    out.push_str(&wrapped(&part.about, WIDTH, "", ""));
    out.push('\n');
    for (label, text) in facts(part) {
        let first = format!("{label:LABEL$}  ");
        let others = " ".repeat(LABEL + 2);
        out.push_str(&wrapped(&text, WIDTH, &first, &others));
    }
    out.push_str(&wires(part));
    out.push_str(&values(part));
    if !part.module.notes.is_empty() {
        out.push_str("\nNotes\n");
        for note in &part.module.notes {
            out.push_str(&wrapped(note, WIDTH, "  - ", "    "));
        }
    }
    out.push_str("\nExample\n");
    for line in example(part).lines() {
        let _ = writeln!(out, "  {line}");
    }
    out
}

fn facts(part: &PartFacts) -> Vec<(&'static str, String)> {
    let aliases = Some(part.aliases.join(", ")).filter(|text| !text.is_empty());
    let connector = Some(part.module.connector.join(" | ")).filter(|text| !text.is_empty());
    let pull = part.needs_pull_up.then(|| "needs resistors to the supply".to_owned());
    let not_checked = "with nothing: the figures are from the sheet alone";
    let compared = part.checked.clone().unwrap_or_else(|| not_checked.to_owned());
    let all = [
        ("Also called", aliases),
        ("Data sheet", part.sheet.clone()),
        ("Compared", Some(compared)),
        ("Supply", words::supply(part)),
        ("Signals", words::levels(part)),
        ("Pull-up", pull),
        ("Addresses", words::addresses(part)),
        ("Identity", words::identity(part)),
        ("Connector", connector),
    ];
    all.into_iter().filter_map(|(label, text)| Some((label, text?))).collect()
}

fn wires(part: &PartFacts) -> String {
    let rows = part.connections.iter().flat_map(|connection| {
        let wires = Wires::of_driver(connection);
        connection.roles.iter().enumerate().map(move |(at, role)| {
            let first = at == 0;
            let settings = if first { words::settings(&connection.kind) } else { String::new() };
            let kind = if first { connection.kind.name().name() } else { "" };
            let contact = wires.contact(&part.module, *role).unwrap_or("-");
            [wires.wire(*role), kind.to_owned(), contact.to_owned(), settings]
        })
    });
    columns(["Wire", "Kind", "At the part", "Settings"], &rows.collect::<Vec<_>>())
}

fn values(part: &PartFacts) -> String {
    let row = |one: &sensedsl_model::facts::ValueFacts| {
        let way = match one.direction {
            Direction::Sensor => "reads",
            Direction::Actuator => "sets",
        };
        let or_dash = |text: String| if text.is_empty() { "-".to_owned() } else { text };
        [
            words::name(one).to_owned(),
            way.to_owned(),
            one.value.to_string(),
            or_dash(words::unit(one).to_owned()),
            or_dash(words::scale(one)),
            or_dash(words::range(one)),
            words::invalid(one),
        ]
    };
    let rows: Vec<[String; 7]> = part.values.iter().map(row).collect();
    let is_marked = rows.iter().any(|row| row.iter().last().is_some_and(|cell| !cell.is_empty()));
    let invalid = if is_marked { "Invalid" } else { "" };
    columns(["Value", "", "Type", "Unit", "Scale", "Range", invalid], &rows)
}

/// Rows below their headings.
fn columns<const N: usize>(heads: [&str; N], rows: &[[String; N]]) -> String {
    let width = |column: usize| {
        let cells = rows.iter().filter_map(|row| row.get(column)).map(|cell| cell.chars().count());
        cells.chain(heads.get(column).map(|head| head.len())).max().unwrap_or_default()
    };
    let widths: Vec<usize> = (0..N).map(width).collect();
    let mut out = String::from("\n");
    for row in std::iter::once(&heads.map(str::to_owned)).chain(rows) {
        let mut line = String::new();
        for (cell, width) in row.iter().zip(&widths).filter(|(_, width)| **width > 0) {
            let _ = write!(line, "{cell:width$}  ");
        }
        out.push_str(line.trim_end());
        out.push('\n');
    }
    out
}
