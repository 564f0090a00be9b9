//! Columns of text, aligned.

use std::fmt::Write as _;

/// A column's head, and whether its cells are numbers, which are right-aligned.
pub(crate) type Head = (&'static str, bool);

/// The indentation of every line.
pub(crate) const INDENT: &str = "  ";

/// The rows below their heads, with two spaces between columns.
pub(crate) fn table<const N: usize>(heads: [Head; N], rows: &[[String; N]]) -> String {
    let width = |column: usize| {
        let cells = rows.iter().filter_map(|row| row.get(column)).map(|cell| cell.chars().count());
        cells.chain(heads.get(column).map(|(head, _)| head.len())).max().unwrap_or_default()
    };
    let widths: Vec<usize> = (0..N).map(width).collect();
    let mut out = String::new();
    let names = heads.map(|(name, _)| name.to_owned());
    for row in std::iter::once(&names).chain(rows) {
        let mut line = String::new();
        for ((cell, width), (_, number)) in row.iter().zip(&widths).zip(heads) {
            let padding = " ".repeat(width.saturating_sub(cell.chars().count()));
            // Writing to a String cannot fail.
            let _ = if number {
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
