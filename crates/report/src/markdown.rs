//! The wiring sheet: what goes where, as Markdown.

use std::fmt::Write as _;

use sensedsl_diagnostics::visible;
use sensedsl_model::design::Design;
use sensedsl_wiring::assignment::{Assignment, SharedPin, Status};

use crate::rows::{Row, dividers, rows};

/// A table for each board, and the totals.
#[must_use]
pub fn markdown(design: &Design, assignment: &Assignment) -> String {
    let mut out = String::from("# Wiring\n");
    let rows = rows(design, assignment);
    for (on, board) in assignment.used(design) {
        let mcu = board.mcu.as_deref().map_or(String::new(), |mcu| format!(" ({mcu})"));
        // Writing to a String cannot fail.
        let _ = write!(out, "\n## {}{}\n\n", cell(&board.name.value), cell(&mcu));
        out.push_str("| Device | Id | Role | Pin | Signal | Unit | Where | Usages |\n");
        out.push_str("| --- | ---: | --- | --- | --- | --- | --- | ---: |\n");
        for row in rows.iter().filter(|row| row.board == board.name.value) {
            let id = row.ids();
            let _ = writeln!(
                out,
                "| {} | {id} | {} | **{}** | {} | {} | {} | {} |",
                device(row),
                row.role,
                cell(&row.pin),
                cell(&row.signal),
                cell(&row.unit),
                cell(&row.place),
                row.usages,
            );
        }
        for SharedPin { pin, with } in &on.shared {
            let Some(pin) = board.table.pins.get(*pin) else { continue };
            let _ = write!(out, "\n{} is shared with {}.\n", cell(pin.name.as_str()), cell(with));
        }
        for (device, divided) in dividers(design, on) {
            let _ = write!(out, "\n{}: {divided}.\n", cell(device));
        }
        let _ = write!(out, "\nOpportunity cost of this board: {}.\n", on.cost);
    }
    let proof = match assignment.status {
        Status::Optimal => "proved optimal: no wiring costs less",
        Status::Feasible => "valid, not proved to be the best",
    };
    let _ = write!(out, "\nOpportunity cost: {}, {proof}.\n", assignment.cost);
    if assignment.violated > 0 {
        let _ = writeln!(out, "Wishes that could not be met: {}.", assignment.violated);
    }
    out
}

/// The device's name, with those of a chip's values.
fn device(row: &Row) -> String {
    if row.values.is_empty() {
        return cell(&row.device);
    }
    cell(&format!("{} ({})", row.device, row.values.join(", ")))
}

/// Text escaped so that it cannot end its cell, begin markup or become a link, a formula or an
/// entity.
fn cell(text: &str) -> String {
    let mut out = String::new();
    let is_site = text.to_ascii_lowercase().contains("www");
    for c in visible(text).chars() {
        let is_markup = matches!(
            c,
            '|' | '\\'
                | '`'
                | '*'
                | '_'
                | '['
                | ']'
                | '<'
                | '>'
                | '#'
                | '&'
                | '~'
                | '$'
                | ':'
                | '@'
                | '!'
        );
        if is_markup || (is_site && c == '.') {
            out.push('\\');
        }
        out.push(c);
    }
    out
}
