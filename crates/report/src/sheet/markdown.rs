//! The sheet as Markdown: what goes where.

use std::fmt::Write as _;

use sensedsl_diagnostics::visible;
use sensedsl_model::design::Design;
use sensedsl_wiring::assignment::{Assignment, SharedPin, Status};

use super::{BoardSheet, PartSheet, sheets};
use crate::markup::noted;
use crate::rows::{Row, rows};

/// For each board the parts to connect, then a table of all its pins in use; and the totals.
#[must_use]
pub fn markdown(design: &Design, assignment: &Assignment) -> String {
    let mut out = String::from("# Wiring\n");
    let rows = rows(design, assignment);
    for sheet in sheets(design, assignment) {
        let name = &sheet.board.name.value;
        let what = sheet.what();
        // Writing to a String cannot fail.
        let _ = writeln!(out, "\n## {}{}", cell(name), cell(&what));
        build(&mut out, &sheet);
        let of_board: Vec<&Row> = rows.iter().filter(|row| row.board == *name).collect();
        pins(&mut out, &sheet, &of_board);
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

/// Part by part, wire by wire.
fn build(out: &mut String, sheet: &BoardSheet<'_>) {
    let needs: Vec<String> = sheet.needs.iter().map(|need| cell(need)).collect();
    let _ = write!(out, "\nTo build it, besides the parts: {}.\n", needs.join("; "));
    for PartSheet { name, about, lines, notes } in &sheet.parts {
        let about = if about.is_empty() { String::new() } else { format!(": {}", cell(about)) };
        let _ = write!(out, "\n### {}{about}\n\n", cell(name));
        if !lines.is_empty() {
            out.push_str("| At the part | Goes to | Pin | For |\n| --- | --- | --- | --- |\n");
        }
        for line in lines {
            let pin = if line.pin.is_empty() {
                String::new()
            } else {
                format!("**{}**", cell(&line.pin))
            };
            let _ = writeln!(
                out,
                "| {} | {} | {pin} | {} |",
                cell(&line.at_part),
                cell(&line.to),
                cell(&line.purpose),
            );
        }
        if !notes.is_empty() {
            out.push('\n');
        }
        for note in notes {
            let _ = writeln!(out, "- {}", noted(note, cell, code));
        }
    }
}

/// The pins in use, with what they cost.
fn pins(out: &mut String, sheet: &BoardSheet<'_>, rows: &[&Row]) {
    out.push_str("\n### Pins\n\n");
    out.push_str("| Device | Id | Role | Pin | Signal | Unit | Where | Usages |\n");
    out.push_str("| --- | ---: | --- | --- | --- | --- | --- | ---: |\n");
    for row in rows {
        let _ = writeln!(
            out,
            "| {} | {} | {} | **{}** | {} | {} | {} | {} |",
            device(row),
            row.ids(),
            row.role,
            cell(&row.pin),
            cell(&row.signal),
            cell(&row.unit),
            cell(&row.place),
            row.usages,
        );
    }
    for SharedPin { pin, with } in &sheet.wiring.shared {
        let Some(pin) = sheet.board.table.pins.get(*pin) else { continue };
        let _ = write!(out, "\n{} is shared with {}.\n", cell(pin.name.as_str()), cell(with));
    }
    let _ = write!(out, "\nOpportunity cost of this board: {}.\n", sheet.wiring.cost);
}

/// The device's name, with those of a chip's values.
fn device(row: &Row) -> String {
    if row.values.is_empty() {
        return cell(&row.device);
    }
    cell(&format!("{} ({})", row.device, row.values.join(", ")))
}

/// A word of code: between grave accents where it is simple, as text otherwise.
fn code(text: &str) -> String {
    let is_simple = |c: char| c.is_ascii_alphanumeric() || matches!(c, '_' | '.' | '=' | ' ');
    if text.chars().all(is_simple) && !text.trim().is_empty() {
        format!("`{text}`")
    } else {
        cell(text)
    }
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
