//! Points on a grid of characters, eight in each: the dots of Braille.
//!
//! In: points by column and row, each of a line. Out: characters in a buffer, in the colour of their last line.

use ratatui_core::buffer::Buffer;
use ratatui_core::layout::Rect;

use super::style::{Look, Tone};

/// The points of a character.
pub(super) const ACROSS: usize = 2;
pub(super) const DOWN: usize = 4;
/// The bit of each point, by its row and column.
const DOTS: [[u32; ACROSS]; DOWN] = [[0x01, 0x08], [0x02, 0x10], [0x04, 0x20], [0x40, 0x80]];
const BLANK: u32 = 0x2800;
/// The dots of the upper half.
const UPPER: u32 = 0x01 | 0x08 | 0x02 | 0x10;

/// The letter for some dots, if there are any.
fn letter(dots: u32, has_shapes: bool) -> Option<char> {
    match (dots & UPPER != 0, dots & !UPPER != 0) {
        (false, false) => None,
        _ if has_shapes => char::from_u32(BLANK | dots),
        (true, false) => Some('\''),
        (false, true) => Some('.'),
        (true, true) => Some(':'),
    }
}

/// A grid of points.
pub(super) struct Canvas {
    wide: usize,
    high: usize,
    cells: Vec<(u32, usize)>,
}

impl Canvas {
    /// A grid of so many characters.
    pub(super) fn new(wide: usize, high: usize) -> Self {
        Self { wide, high, cells: vec![(0, 0); wide * high] }
    }

    /// The points from left to right, and from top to bottom.
    pub(super) fn size(&self) -> (usize, usize) {
        (self.wide * ACROSS, self.high * DOWN)
    }

    /// Sets the points of a column between two rows, both included.
    pub(super) fn draw(&mut self, column: usize, (one, other): (usize, usize), line: usize) {
        for row in one.min(other)..=one.max(other) {
            if column / ACROSS >= self.wide {
                return;
            }
            let place = (row / DOWN) * self.wide + column / ACROSS;
            let dot = DOTS.get(row % DOWN).and_then(|row| row.get(column % ACROSS));
            if let (Some(cell), Some(dot)) = (self.cells.get_mut(place), dot) {
                *cell = (cell.0 | dot, line);
            }
        }
    }

    /// Writes what has points.
    pub(super) fn show(&self, buffer: &mut Buffer, area: Rect, look: Look) {
        let area = area.intersection(buffer.area);
        for (row, cells) in (area.y..area.bottom()).zip(self.cells.chunks(self.wide.max(1))) {
            for (column, (dots, line)) in (area.x..area.right()).zip(cells) {
                let letter = letter(*dots, look.has_shapes);
                if let (Some(letter), Some(cell)) = (letter, buffer.cell_mut((column, row))) {
                    let _ = cell.set_char(letter).set_style(look.of(Tone::Line(*line)));
                }
            }
        }
    }
}
