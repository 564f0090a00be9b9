//! Columns of text, aligned.

use std::fmt::Write as _;

/// The mark before the head of a column of numbers, which are right-aligned.
const NUMBERS: char = '>';

/// The indentation of every line.
pub const INDENT: &str = "  ";

/// The rows below their heads, with two spaces between columns.
#[must_use]
pub fn table<const N: usize>(heads: [&str; N], rows: &[[String; N]]) -> String {
    let names = heads.map(|head| head.trim_start_matches(NUMBERS).to_owned());
    let width = |column: usize| {
        let cells = std::iter::once(&names).chain(rows).filter_map(|row| row.get(column));
        cells.map(|cell| cell.chars().count()).max().unwrap_or_default()
    };
    let widths: Vec<usize> = (0..N).map(width).collect();
    let mut out = String::new();
    for row in std::iter::once(&names).chain(rows) {
        let mut line = String::new();
        for ((cell, width), head) in row.iter().zip(&widths).zip(heads) {
            let padding = " ".repeat(width.saturating_sub(cell.chars().count()));
            // Writing to a String cannot fail.
            let _ = if head.starts_with(NUMBERS) {
                write!(line, "  {padding}{cell}")
            } else {
                write!(line, "  {cell}{padding}")
            };
        }
        out.push_str(line.trim_end());
        out.push('\n');
    }
    out
}
