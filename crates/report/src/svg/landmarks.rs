//! Buttons and LEDs: their symbols where they are on the board, and their names, each where it touches nothing.

use std::fmt::Write as _;

use sensedsl_board::landmark::LandmarkKind;

use super::area::{Area, Point};
use super::marks::circle;
use super::shape::{Landmark, Shape};
use super::text::{Anchor, Text, cut, number};
use crate::markup::escaped;

/// The font size of names.
const SIZE: f64 = 8.0;
/// From the edge of a symbol to its name.
const GAP: f64 = 4.0;
/// The room for a name.
const ROOM: f64 = 80.0;
/// Between the outline of the board and a name.
const BORDER: f64 = 2.0;
/// How far a symbol may be moved up or down to be between two lines of text, in steps: 1.25 mm.
const MOVE_MAX: u8 = 10;

/// A symbol in the picture: something round on a body.
#[derive(Clone, Debug)]
pub(super) struct Symbol {
    pub(super) kind: LandmarkKind,
    at: Point,
    pub(super) body: Area,
    radius: f64,
}

/// A button or LED that has room.
#[derive(Clone, Debug)]
pub(super) struct Placed {
    pub(super) symbol: Symbol,
    title: String,
}

impl Symbol {
    /// The symbol that the legend shows.
    pub(super) fn small(kind: LandmarkKind, at: Point) -> Self {
        let (width, height, radius) = match kind {
            LandmarkKind::Button => (8.0, 8.0, 2.0),
            LandmarkKind::Led => (14.0, 8.0, 2.5),
        };
        Self { kind, at, body: Area::around(at, width, height), radius }
    }

    /// As large as a button of 3.25 mm; an LED is as in the legend.
    fn large(kind: LandmarkKind, at: Point) -> Self {
        match kind {
            LandmarkKind::Button => {
                Self { kind, at, body: Area::around(at, 26.0, 26.0), radius: 8.0 }
            }
            LandmarkKind::Led => Self::small(kind, at),
        }
    }

    pub(super) fn draw(&self, out: &mut String) {
        let Area { left, top, right, bottom } = self.body;
        let [x, y, width, height] = [left, top, right - left, bottom - top].map(number);
        // Writing to a String cannot fail.
        let _ = writeln!(
            out,
            "<rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" rx=\"2\" class=\"sd-landmark\"/>"
        );
        circle(out, self.at, self.radius, "sd-landmark");
    }
}

/// Draws those of a board.
pub(super) fn draw(out: &mut String, landmarks: &[Placed]) {
    for one in landmarks {
        let _ = writeln!(out, "<g><title>{}</title>", escaped(&one.title));
        one.symbol.draw(out);
        out.push_str("</g>\n");
    }
}

/// Places the buttons and LEDs of a board, and adds their names to its texts. What has no room is left out.
///
/// All symbols come before all names; a symbol is moved again where that makes room for its name.
pub(super) fn place(board: &Shape<'_>, taken: &[Area], texts: &mut Vec<Text>) -> Vec<Placed> {
    let mut placed: Vec<Placed> = Vec::new();
    let mut shown: Vec<&Landmark<'_>> = Vec::new();
    for one in &board.landmarks {
        let others = occupied(taken, texts, &placed);
        if let Some(symbol) = choices(one).find(|symbol| is_free(&symbol.body, &others)) {
            let title = format!("{} {}", one.kind.word(), words(one));
            placed.push(Placed { symbol, title });
            shown.push(one);
        }
    }
    for (at, one) in shown.into_iter().enumerate() {
        let Some(first) = placed.get(at).map(|placed| placed.symbol.clone()) else { continue };
        let mut others = placed.clone();
        others.remove(at);
        let others = occupied(taken, texts, &others);
        let choices = std::iter::once(first).chain(choices(one));
        let mut choices = choices.filter(|symbol| is_free(&symbol.body, &others));
        let found = choices.find_map(|symbol| Some((name(board, one, &symbol, &others)?, symbol)));
        if let (Some((name, symbol)), Some(placed)) = (found, placed.get_mut(at)) {
            placed.symbol = symbol;
            texts.push(name);
        }
    }
    placed
}

/// What symbols and names must not touch.
fn occupied(taken: &[Area], texts: &[Text], placed: &[Placed]) -> Vec<Area> {
    let bodies = placed.iter().map(|one| one.symbol.body);
    texts.iter().map(Text::area).chain(taken.iter().copied()).chain(bodies).collect()
}

fn is_free(area: &Area, others: &[Area]) -> bool {
    !others.iter().any(|other| other.meets(area))
}

/// The name of a landmark beside its symbol, with its pin if there is room.
fn name(board: &Shape<'_>, one: &Landmark<'_>, symbol: &Symbol, others: &[Area]) -> Option<Text> {
    let choices = [words(one), one.name.clone()];
    let mut texts = choices.iter().flat_map(|words| beside(symbol, &cut(words, SIZE, ROOM)));
    texts.find(|text| {
        let area = text.area();
        is_inside(board, &area) && is_free(&area, others) && !symbol.body.meets(&area)
    })
}

/// The ways to draw a landmark, the best first.
fn choices(one: &Landmark<'_>) -> impl Iterator<Item = Symbol> {
    let kind = one.kind;
    let (x, y) = one.at;
    let moves = (0..=MOVE_MAX).map(f64::from).flat_map(|by| [by, -by]);
    let small = moves.map(move |by| Symbol::small(kind, (x, y + by)));
    std::iter::once(Symbol::large(kind, one.at)).chain(small)
}

/// The name and its pin.
fn words(one: &Landmark<'_>) -> String {
    match one.pin {
        Some(pin) => format!("{} {}", one.name, pin.name),
        None => one.name.clone(),
    }
}

/// A text on each side of a symbol, the best first.
fn beside(symbol: &Symbol, words: &str) -> [Text; 4] {
    let Area { left, top, right, bottom } = symbol.body;
    let (x, y) = symbol.at;
    let at = |point, anchor| Text::new(point, SIZE, "sd-soft", words).anchored(anchor);
    [
        at((right + GAP, y), Anchor::Start),
        at((left - GAP, y), Anchor::End),
        at((x, bottom + GAP + SIZE / 2.0), Anchor::Middle),
        at((x, top - GAP - SIZE / 2.0), Anchor::Middle),
    ]
}

fn is_inside(board: &Shape<'_>, area: &Area) -> bool {
    area.left > BORDER
        && area.top > BORDER
        && area.right < board.width - BORDER
        && area.bottom < board.height - BORDER
}
