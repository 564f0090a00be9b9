//! The marks of contacts: which kind of device one carries, or why it carries none.

use std::fmt::Write as _;

use super::area::Point;
use super::palette::letter;
use super::text::{Anchor, Text, number};

/// The size of the letters in marks.
const SIZE: f64 = 8.5;
/// The radius of the mark of a kind.
const KIND: f64 = 6.0;
/// The radius of the mark of a pin that nothing uses.
const PIN: f64 = 4.0;

/// What a contact without a wire is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Unused {
    Free,
    /// Something on the board is on it, but it can be used.
    WithCare,
    Taken,
    /// Supply, ground, reset.
    Supply,
    /// Not connected, or not known.
    Open,
}

impl Unused {
    /// The words of the legend.
    pub(super) const fn words(self) -> &'static str {
        match self {
            Self::Free => "free",
            Self::WithCare => "free, with a part of the board on it",
            Self::Taken => "taken or kept back",
            Self::Supply => "supply, ground, reset",
            Self::Open => "not connected, or unknown",
        }
    }
}

/// The mark of a kind: its letter in its colour.
pub(super) fn of_kind(out: &mut String, at: Point, kind: &str) {
    circle(out, at, KIND, &format!("sd-pad-{kind}"));
    let text = Text::new(at, SIZE, format!("sd-on-{kind}"), &letter(kind).to_string());
    text.anchored(Anchor::Middle).write(out);
}

/// The ring around the mark of a pin that something else on the board is on.
pub(super) fn shared(out: &mut String, at: Point) {
    circle(out, at, KIND + 1.8, "sd-shared");
}

/// The mark of a contact without a wire.
pub(super) fn unused(out: &mut String, (x, y): Point, what: Unused) {
    match what {
        Unused::Free => circle(out, (x, y), PIN, "sd-free"),
        Unused::WithCare => {
            circle(out, (x, y), PIN, "sd-free");
            circle(out, (x, y), 1.5, "sd-taken");
        }
        Unused::Taken => {
            circle(out, (x, y), PIN, "sd-taken");
            let [left, right, top, bottom] = [x - 2.8, x + 2.8, y - 2.8, y + 2.8].map(number);
            // Writing to a String cannot fail.
            let _ = writeln!(
                out,
                "<path d=\"M{left} {top}L{right} {bottom}M{left} {bottom}L{right} {top}\" \
                 class=\"sd-line\" fill=\"none\"/>"
            );
        }
        Unused::Supply => {
            let (left, top) = (number(x - PIN), number(y - PIN));
            let size = number(2.0 * PIN);
            let _ = writeln!(
                out,
                "<rect x=\"{left}\" y=\"{top}\" width=\"{size}\" height=\"{size}\" class=\"sd-free\"/>"
            );
        }
        Unused::Open => circle(out, (x, y), 1.5, "sd-taken"),
    }
}

/// A circle.
pub(super) fn circle(out: &mut String, (x, y): Point, radius: f64, class: &str) {
    let [x, y, radius] = [x, y, radius].map(number);
    let _ = writeln!(out, "<circle cx=\"{x}\" cy=\"{y}\" r=\"{radius}\" class=\"{class}\"/>");
}
