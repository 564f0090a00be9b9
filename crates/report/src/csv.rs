//! A wiring as CSV, for spreadsheets.

use sensedsl_diagnostics::visible;
use sensedsl_model::design::Design;
use sensedsl_wiring::assignment::Assignment;

use crate::rows::{Row, rows};

const HEAD: [&str; 11] = [
    "Board",
    "Device",
    "Id",
    "Kind",
    "Role",
    "Pin",
    "Signal",
    "Unit",
    "Place",
    "Usages",
    "Shared with",
];

/// A heading and a row for each wire.
#[must_use]
pub fn csv(design: &Design, assignment: &Assignment) -> String {
    let mut out = line(&HEAD.map(String::from));
    for row in rows(design, assignment) {
        let id = row.ids();
        let Row { board, device, kind, role, pin, signal, unit, place, shared, usages, .. } = row;
        let usages = usages.to_string();
        out.push_str(&line(&[
            board, device, id, kind, role, pin, signal, unit, place, usages, shared,
        ]));
    }
    out
}

fn line(cells: &[String]) -> String {
    let cells: Vec<String> = cells.iter().map(|cell| quoted(cell)).collect();
    format!("{}\n", cells.join(","))
}

/// A cell as RFC 4180 requires it, and such that a spreadsheet takes it for text: a cell that would
/// begin a formula gets the apostrophe that spreadsheets know for that.
fn quoted(cell: &str) -> String {
    let cell = visible(cell);
    let is_formula = cell.len() > 1 && cell.starts_with(['=', '+', '-', '@']);
    let cell = if is_formula { format!("'{cell}") } else { cell.into_owned() };
    if cell.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", cell.replace('"', "\"\""))
    } else {
        cell
    }
}
