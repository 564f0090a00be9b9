//! A box for each chip of a board: its name, its values with their identifiers, and its wires.

use std::fmt::Write as _;

use super::{MARGIN, WIDTH, colour, cut, escaped};
use crate::rows::Row;

/// Number of boxes side by side.
const COLUMNS: usize = 4;
const GAP: usize = 12;
const BOX_WIDTH: usize = (WIDTH - 2 * MARGIN - (COLUMNS - 1) * GAP) / COLUMNS;
const HEAD_HEIGHT: usize = 30;
const LINE_HEIGHT: usize = 16;
/// Characters that fit on a line of a box.
const LETTERS_MAX: usize = 34;

/// Draws the chips of one board, whose rows are given, and returns where the next thing begins.
pub(super) fn boxes(out: &mut String, top: usize, rows: &[&Row]) -> usize {
    let groups = rows.chunk_by(|one, next| one.device == next.device);
    let is_chip = |group: &&[&Row]| group.first().is_some_and(|row| !row.values.is_empty());
    let chips: Vec<&[&Row]> = groups.filter(is_chip).collect();
    let mut y = top;
    for line in chips.chunks(COLUMNS) {
        let height = line.iter().map(|chip| height(chip)).max().unwrap_or_default();
        for (at, chip) in line.iter().enumerate() {
            chip_box(out, (MARGIN + at * (BOX_WIDTH + GAP), y), height, chip);
        }
        y += height + GAP;
    }
    y
}

fn height(chip: &[&Row]) -> usize {
    let values = chip.first().map_or(0, |row| row.values.len());
    HEAD_HEIGHT + (values + chip.len()) * LINE_HEIGHT + LINE_HEIGHT / 2
}

fn chip_box(out: &mut String, (x, y): (usize, usize), height: usize, chip: &[&Row]) {
    let Some(first) = chip.first() else { return };
    // Writing to a String cannot fail.
    let _ = writeln!(
        out,
        "<rect x=\"{x}\" y=\"{y}\" width=\"{BOX_WIDTH}\" height=\"{height}\" rx=\"6\" \
         fill=\"#F4F6F8\" stroke=\"#33475B\"/>\n<text x=\"{}\" y=\"{}\" font-weight=\"bold\" \
         fill=\"#1B2733\">{}</text>",
        x + 10,
        y + 20,
        escaped(&cut(&first.device, LETTERS_MAX - 6)),
    );
    let mut baseline = y + HEAD_HEIGHT + LINE_HEIGHT - 6;
    for (value, id) in first.values.iter().zip(&first.ids) {
        let text = escaped(&cut(&format!("{id}  {value}"), LETTERS_MAX));
        let _ = writeln!(
            out,
            "<text x=\"{}\" y=\"{baseline}\" font-size=\"11\" fill=\"#1B2733\">{text}</text>",
            x + 10
        );
        baseline += LINE_HEIGHT;
    }
    for row in chip {
        let text = escaped(&cut(&format!("{}  {}", row.role, row.pin), LETTERS_MAX));
        let _ = writeln!(
            out,
            "<rect x=\"{}\" y=\"{}\" width=\"8\" height=\"8\" fill=\"{}\" stroke=\"#33475B\"/>\n\
             <text x=\"{}\" y=\"{baseline}\" font-size=\"11\" fill=\"#33475B\">{text}</text>",
            x + 10,
            baseline - 8,
            colour(&row.kind),
            x + 24,
        );
        baseline += LINE_HEIGHT;
    }
}
