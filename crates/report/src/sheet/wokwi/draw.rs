//! Where things are, and the text of the diagram. In: boards and parts one after the other. Out: the file.
//!
//! A board is in the middle, its parts are in a column on either side, each below its name; what is left out stands
//! below them. Between board and columns each wire has a lane of its own. Places are in pixels.

use std::fmt::Write as _;

use sensedsl_diagnostics::visible;
use serde_json::{Value, json};

use super::Drawn;
use super::boards::WokwiBoard;
use super::route::{Area, Lanes, Side};
use super::table::{self, Rail};

/// The space below a part.
const GAP: i32 = 40;
/// The height of a line of text, and the width of a letter.
const LINE: i32 = 24;
const LETTER: i32 = 9;
/// The space between a resistor and what follows it.
const AFTER_RESISTOR: i32 = 30;

/// The colours of wires that carry signals, one after the other.
const COLOURS: [&str; 8] =
    ["green", "blue", "orange", "purple", "cyan", "magenta", "gold", "limegreen"];

/// A diagram that grows.
#[derive(Default)]
pub(super) struct Canvas {
    parts: Vec<Value>,
    wires: Vec<Value>,
    board: Option<Placed>,
    /// The top of the next board.
    top: i32,
    notes: Vec<String>,
}

/// A board with what is around it.
struct Placed {
    id: String,
    board: &'static WokwiBoard,
    lanes: Lanes,
    /// The lower ends of the two columns.
    down: [i32; 2],
    /// The contacts of rails that have been given out, and the signals that have been drawn.
    taken: [usize; 3],
    signals: usize,
}

/// A part on the diagram.
struct Item<'a> {
    kind: &'static str,
    id: &'a str,
    at: Area,
    side: Side,
}

impl Canvas {
    /// Begins a board, below those before.
    pub(super) fn begin(&mut self, id: &str, board: &'static WokwiBoard) {
        let at = Area { left: 0, top: self.top, width: board.size.0, height: board.size.1 };
        self.part(board.kind, id, (0, self.top), &[]);
        self.board = Some(Placed {
            id: id.to_owned(),
            board,
            lanes: Lanes::around(at),
            down: [self.top; 2],
            taken: [0; 3],
            signals: 0,
        });
    }

    /// Ends it with what is left out.
    pub(super) fn end(&mut self) {
        let Some(placed) = self.board.take() else { return };
        let mut top = placed.down.into_iter().fold(placed.lanes.bottom(), i32::max) + GAP;
        if !self.notes.is_empty() {
            let lines = std::mem::take(&mut self.notes);
            let text = format!("Not in this diagram:\n{}", lines.join("\n"));
            self.part(
                "wokwi-text",
                &format!("{}-left-out", placed.id),
                (0, top),
                &[("text", &text)],
            );
            top += LINE * (i32::try_from(lines.len()).unwrap_or_default() + 1) + GAP;
        }
        self.top = top + GAP;
    }

    /// Notes a part that is left out.
    pub(super) fn note(&mut self, text: &str) {
        self.notes.push(visible(text).into_owned());
    }

    /// Draws a wire to the host, which is the serial monitor.
    pub(super) fn host(&mut self, contact: Option<&str>, end: &str) {
        if let (Some(contact), Some(placed)) = (contact, &self.board) {
            let from = format!("{}:{contact}", placed.id);
            self.wires.push(json!([from, format!("$serialMonitor:{end}"), "", []]));
        }
    }

    /// Draws a part with its wires.
    pub(super) fn add(&mut self, one: &Drawn) {
        let how = one.how;
        let (width, height) = table::size(how.kind);
        let before = how.ohms.map_or(0, |_| table::size("wokwi-resistor").0 + AFTER_RESISTOR);
        let letters = i32::try_from(one.label.chars().count()).unwrap_or_default();
        let cell = ((width + before).max(LETTER * letters), height + LINE);
        let Some((left, top, side)) = self.place(cell) else { return };
        let label = visible(&one.label).into_owned();
        self.part("wokwi-text", &format!("{}-name", one.id), (left, top), &[("text", &label)]);
        // On the left, it is the right end that is near the board.
        let left = if side == Side::Left { left + cell.0 - width - before } else { left };
        let at = Area { left: left + before, top: top + LINE, width, height };
        self.part(how.kind, &one.id, (at.left, at.top), how.attributes);
        let part = Item { kind: how.kind, id: &one.id, at, side };
        let mut number = 0;
        for (at_part, of_board) in &one.wires {
            let colour = self.colour();
            let Some(ohms) = how.ohms else {
                self.wire(of_board, &part, (at_part, number), colour);
                number += 1;
                continue;
            };
            let (id, size) = (format!("{}-resistor", one.id), table::size("wokwi-resistor"));
            let at = Area { left, top: at.top + AFTER_RESISTOR, width: size.0, height: size.1 };
            self.part("wokwi-resistor", &id, (at.left, at.top), &[("value", ohms)]);
            let resistor = Item { kind: "wokwi-resistor", id: &id, at, side };
            self.wire(of_board, &resistor, ("1", number), colour);
            number += 1;
            let ends = [format!("{id}:2"), format!("{}:{at_part}", one.id)];
            self.wires.push(json!([ends[0], ends[1], colour, []]));
        }
        let high = one.high.map(|contact| {
            let supply = how.rails.iter().find(|(_, rail)| *rail != Rail::Ground);
            (contact, supply.map_or(Rail::Logic, |(_, rail)| *rail))
        });
        for (at_part, rail) in how.rails.iter().copied().chain(high) {
            let (contact, colour) = self.rail(rail);
            self.wire(contact, &part, (at_part, number), colour);
            number += 1;
        }
    }

    /// A wire from the board to a contact of a part, which is the part's wire of this number.
    fn wire(&mut self, of_board: &str, part: &Item<'_>, to: (&str, i32), colour: &str) {
        let Some(placed) = &mut self.board else { return };
        let (contact, number) = to;
        let from = table::at(placed.board.contacts, of_board);
        let end = table::place(part.kind, contact);
        let moves = placed.lanes.route(from, (part.at, end), part.side, number);
        let ends = [format!("{}:{of_board}", placed.id), format!("{}:{contact}", part.id)];
        self.wires.push(json!([ends[0], ends[1], colour, moves]));
    }

    /// The colour of the next signal.
    fn colour(&mut self) -> &'static str {
        let number = self.board.as_mut().map_or(0, |placed| {
            placed.signals += 1;
            placed.signals - 1
        });
        COLOURS.get(number % COLOURS.len()).copied().unwrap_or("green")
    }

    /// The next contact of a rail, and the colour of its wires.
    fn rail(&mut self, rail: Rail) -> (&'static str, &'static str) {
        let Some(placed) = &mut self.board else { return ("", "") };
        let rail = if rail == Rail::Logic { placed.board.logic } else { rail };
        let (number, all, colour) = match rail {
            Rail::Ground => (0, placed.board.ground, "black"),
            Rail::Three => (1, placed.board.three, "red"),
            Rail::Five | Rail::Logic => (2, placed.board.five, "red"),
        };
        let mut next = 0;
        if let Some(taken) = placed.taken.get_mut(number) {
            next = *taken;
            *taken += 1;
        }
        (all.get(next % all.len().max(1)).copied().unwrap_or_default(), colour)
    }

    /// The place of a part of this size, at the end of the shorter column.
    fn place(&mut self, (width, height): (i32, i32)) -> Option<(i32, i32, Side)> {
        let placed = self.board.as_mut()?;
        let [left, right] = &mut placed.down;
        let (down, side) = if *right <= *left { (right, Side::Right) } else { (left, Side::Left) };
        let top = *down;
        *down += height + GAP;
        let at = match side {
            Side::Left => placed.lanes.end(side) - width,
            Side::Right => placed.lanes.end(side),
        };
        Some((at, top, side))
    }

    fn part(&mut self, kind: &str, id: &str, (left, top): (i32, i32), attributes: &[(&str, &str)]) {
        let attributes: serde_json::Map<String, Value> =
            attributes.iter().map(|(name, value)| ((*name).to_owned(), (*value).into())).collect();
        self.parts
            .push(json!({ "type": kind, "id": id, "top": top, "left": left, "attrs": attributes }));
    }

    /// The file: a part or a wire a line.
    pub(super) fn print(&self) -> String {
        let lines = |values: &[Value]| {
            let mut out = String::new();
            for (number, value) in values.iter().enumerate() {
                // Writing to a String cannot fail.
                let _ = write!(out, "{}\n    {value}", if number == 0 { "" } else { "," });
            }
            out
        };
        format!(
            "{{\n  \"version\": 1,\n  \"author\": \"SenseDSL\",\n  \"editor\": \"wokwi\",\n  \"parts\": [{}\n  ],\n  \
             \"connections\": [{}\n  ]\n}}\n",
            lines(&self.parts),
            lines(&self.wires),
        )
    }
}
