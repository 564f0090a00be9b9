//! The boxes of parts beside a board: how high they are, where they are, and their texts.

use std::fmt::Write as _;

use super::area::{Area, Point, Side};
use super::marks;
use super::parts::Part;
use super::text::{Anchor, Text, cut, number, width};
use crate::markup::escaped;

pub(super) const WIDTH: f64 = 236.0;
const HEAD: f64 = 24.0;
const LINE: f64 = 15.0;
const FOOT: f64 = 5.0;
/// Between boxes, one below the other.
const GAP: f64 = 10.0;
const NAME_SIZE: f64 = 12.0;
const SIZE: f64 = 10.5;
/// From the edge of a box to its texts.
const INSET: f64 = 10.0;

/// A part in its box.
#[derive(Clone, Debug)]
pub(super) struct PartBox<'p> {
    pub(super) part: &'p Part,
    pub(super) side: Side,
    /// The order of its wires, by the index into the part's.
    pub(super) order: Vec<usize>,
    pub(super) top: f64,
}

impl PartBox<'_> {
    /// The height: depends on the part alone.
    pub(super) fn height(&self) -> f64 {
        let shared = self.part.wires.iter().filter(|wire| !wire.shared.is_empty()).count();
        let others = self.part.remarks.len() + self.part.supply.len();
        let lines = self.part.values.len() + self.part.wires.len() + shared + others;
        HEAD + lines_height(lines) + FOOT
    }

    /// The heights of the ends of its wires below its top, with the wires' indices, from above.
    pub(super) fn ends(&self) -> Vec<(usize, f64)> {
        let mut y = HEAD + lines_height(self.part.values.len());
        let mut ends = Vec::new();
        for &index in &self.order {
            ends.push((index, y + LINE / 2.0));
            let shared = self.part.wires.get(index).is_some_and(|wire| !wire.shared.is_empty());
            y += if shared { 2.0 * LINE } else { LINE };
        }
        ends
    }
}

fn lines_height(lines: usize) -> f64 {
    // Boxes have few lines: a u16 holds them, and what is more is cut by the page anyway.
    f64::from(u16::try_from(lines).unwrap_or(u16::MAX)) * LINE
}

/// Puts the boxes of one side below each other, each as near as possible to the height that it
/// wants. They stay beside the board, whose height is given, or extend over both ends of it.
pub(super) fn stack(boxes: &mut [PartBox<'_>], wanted: &[f64], height: f64) {
    let total = boxes.iter().map(|one| one.height() + GAP).sum::<f64>() - GAP;
    let beyond = (total - height).max(0.0) / 2.0;
    let mut next = -beyond;
    for (one, wanted) in boxes.iter_mut().zip(wanted) {
        one.top = wanted.max(next);
        next = one.top + one.height() + GAP;
    }
    let mut limit = height + beyond;
    for one in boxes.iter_mut().rev() {
        one.top = one.top.min(limit - one.height());
        limit = one.top - GAP;
    }
}

/// Draws a box whose inner edge is at `x`, and returns its area. `marks` gives the height of the end
/// of each wire, by the wire's index.
pub(super) fn draw(out: &mut String, one: &PartBox<'_>, x: f64, marks: &[f64]) -> Area {
    let (left, right) = match one.side {
        Side::Left => (x - WIDTH, x),
        Side::Right => (x, x + WIDTH),
    };
    let area = Area { left, top: one.top, right, bottom: one.top + one.height() };
    // Writing to a String cannot fail.
    let _ = writeln!(
        out,
        "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" rx=\"5\" class=\"sd-box\"/>",
        number(left),
        number(one.top),
        number(WIDTH),
        number(one.height())
    );
    head(out, one.part, (left, right), one.top + HEAD / 2.0 + 1.0);
    let mut pen = Pen { out, left: left + INSET, y: one.top + HEAD + LINE / 2.0 };
    for value in &one.part.values {
        pen.line("sd-ink", value);
    }
    for &index in &one.order {
        let Some(wire) = one.part.wires.get(index) else { continue };
        let end = marks.get(index).copied().unwrap_or(pen.y);
        marks::of_kind(pen.out, (x, end), &wire.kind);
        let text = wire.text();
        pen.line_or("sd-ink", &format!("{text} ({})", wire.signal), &text);
        if !wire.shared.is_empty() {
            pen.line("sd-soft", &format!("shared with {}", wire.shared));
        }
    }
    for text in one.part.remarks.iter().chain(&one.part.supply) {
        pen.line("sd-soft", text);
    }
    area
}

/// Writes the lines of a box, one below the other.
struct Pen<'o> {
    out: &'o mut String,
    left: f64,
    y: f64,
}

impl Pen<'_> {
    fn line(&mut self, class: &'static str, text: &str) {
        self.line_or(class, text, text);
    }

    /// The text, or the shorter one where there is no room for it.
    fn line_or(&mut self, class: &'static str, text: &str, shorter: &str) {
        let room = WIDTH - 2.0 * INSET;
        let shown = if width(text, SIZE) <= room { text } else { shorter };
        let shown = cut(shown, SIZE, room);
        let line = Text::new((self.left, self.y), SIZE, class, &shown);
        // What is cut can be read by pointing at it.
        if shown == text {
            line.write(self.out);
        } else {
            let _ = write!(self.out, "<g><title>{}</title>", escaped(text));
            line.write(self.out);
            self.out.push_str("</g>\n");
        }
        self.y += LINE;
    }
}

/// The name of a part, and what is beside it.
fn head(out: &mut String, part: &Part, (left, right): Point, y: f64) {
    let note = cut(&part.note, SIZE, WIDTH / 2.0);
    let room = WIDTH - 2.0 * INSET - width(&note, SIZE) - 8.0;
    let name = cut(&part.name, NAME_SIZE, room);
    Text::new((left + INSET, y), NAME_SIZE, "sd-ink", &name).bold(true).write(out);
    if !note.is_empty() {
        Text::new((right - INSET, y), SIZE, "sd-soft", &note).anchored(Anchor::End).write(out);
    }
}
