//! The wires of a part in a wiring, in words.
//!
//! The wiring may be of an earlier text, so that parts are found by their names.

use sensedsl_model::design::{Design, PartIndex};
use sensedsl_report::{Row, rows};
use sensedsl_wiring::assignment::Assignment;

/// Most wires that a short text names.
const SHORT_MAX: usize = 4;

/// The rows of a part; that of a device in a chip is the chip.
pub(crate) fn of_part(rows: &[Row], part: &str) -> Vec<Row> {
    rows.iter().filter(|row| row.device == part).cloned().collect()
}

/// All rows of a wiring.
pub(crate) fn all((design, wiring): (&Design, &Assignment)) -> Vec<Row> {
    rows(design, wiring)
}

/// The name of the part that a device or chip of that name belongs to.
pub(crate) fn part_of<'a>(design: &'a Design, name: &str) -> Option<(PartIndex, &'a str)> {
    let device = design.devices.iter().find(|one| one.name.value == name).map(|one| one.part);
    let part = device
        .or_else(|| design.parts.iter().position(|one| one.name.value == name).map(PartIndex))?;
    Some((part, design.part_name(part)))
}

/// The pins in a few words: `PA0`, `scl PB6, sda PB7`.
pub(crate) fn short(rows: &[Row]) -> String {
    let pin = |row: &Row| match &row.label {
        Some(label) => format!("{} ({label})", row.pin),
        None => row.pin.clone(),
    };
    if let [row] = rows {
        return pin(row);
    }
    let words = rows.iter().take(SHORT_MAX).map(|row| format!("{} {}", row.role, pin(row)));
    let mut words = words.collect::<Vec<_>>().join(", ");
    if rows.len() > SHORT_MAX {
        words.push_str(&format!(", … {} more", rows.len() - SHORT_MAX));
    }
    words
}

/// The opportunity cost of the pins, each once.
pub(crate) fn cost(rows: &[Row]) -> u32 {
    let mut pins: Vec<(&str, u32)> =
        rows.iter().map(|row| (row.pin.as_str(), row.usages)).collect();
    pins.sort_unstable();
    pins.dedup();
    pins.iter().map(|(_, usages)| usages).sum()
}

/// The wires as a table in Markdown.
pub(crate) fn table(rows: &[Row]) -> String {
    let mut out =
        "| wire | pin | signal | unit | where | usages |\n| --- | --- | --- | --- | --- | --- |\n"
            .to_owned();
    for row in rows {
        let Row { role, pin, signal, unit, place, usages, .. } = row;
        let cells = [role, pin, signal, unit, place].map(|cell| escaped(cell));
        out.push_str(&format!("| {} | {usages} |\n", cells.join(" | ")));
    }
    out
}

/// A text in a cell of Markdown.
pub(crate) fn escaped(text: &str) -> String {
    let mut out = String::new();
    for one in text.chars() {
        if "|\\`*_<>[]".contains(one) {
            out.push('\\');
        }
        out.push(if one == '\n' { ' ' } else { one });
    }
    out
}
