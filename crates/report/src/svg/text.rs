//! Text in a picture: how much room it takes, how it is cut to its room and written as XML.
//!
//! A picture is shown in whatever font its reader has. Widths are therefore estimates on the safe
//! side: text takes no more room than is computed here.

use std::borrow::Cow;
use std::fmt::Write as _;

use sensedsl_diagnostics::visible;

use super::area::{Area, Point};
use crate::markup::escaped;

/// The height of a line of text, as a multiple of the font size.
const HEIGHT: f64 = 1.15;
/// How much wider bold text is.
const BOLD: f64 = 1.06;
/// How far the baseline is below the middle of a line, as a multiple of the font size.
const BASELINE: f64 = 0.35;

/// The point of a text that is given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

/// One line of text.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Text {
    /// The anchor, in the middle of the line's height.
    pub(super) at: Point,
    pub(super) anchor: Anchor,
    pub(super) size: f64,
    /// The class of the style sheet that colours it.
    pub(super) class: Cow<'static, str>,
    pub(super) is_bold: bool,
    /// Whether it runs up the page instead of along it.
    pub(super) is_turned: bool,
    pub(super) content: String,
}

impl Text {
    /// A line that starts at a point.
    pub(super) fn new(
        at: Point,
        size: f64,
        class: impl Into<Cow<'static, str>>,
        content: &str,
    ) -> Self {
        let (anchor, class, content) = (Anchor::Start, class.into(), content.to_owned());
        Self { at, anchor, size, class, is_bold: false, is_turned: false, content }
    }

    /// The same with another anchor.
    pub(super) fn anchored(self, anchor: Anchor) -> Self {
        Self { anchor, ..self }
    }

    /// The same in bold.
    pub(super) fn bold(self, is_bold: bool) -> Self {
        Self { is_bold, ..self }
    }

    /// The same, running up the page if `is_turned`.
    pub(super) fn turned(self, is_turned: bool) -> Self {
        Self { is_turned, ..self }
    }

    /// The room that it takes.
    pub(super) fn area(&self) -> Area {
        let (x, y) = self.at;
        let long = width(&self.content, self.size) * if self.is_bold { BOLD } else { 1.0 };
        let tall = self.size * HEIGHT;
        let along = match self.anchor {
            Anchor::Start => long / 2.0,
            Anchor::Middle => 0.0,
            Anchor::End => -long / 2.0,
        };
        if self.is_turned {
            Area::around((x, y - along), tall, long)
        } else {
            Area::around((x + along, y), long, tall)
        }
    }

    /// Writes it as an element.
    pub(super) fn write(&self, out: &mut String) {
        let (x, y) = self.at;
        let down = self.size * BASELINE;
        let anchor = match self.anchor {
            Anchor::Start => "",
            Anchor::Middle => " text-anchor=\"middle\"",
            Anchor::End => " text-anchor=\"end\"",
        };
        let weight = if self.is_bold { " font-weight=\"bold\"" } else { "" };
        let (x, y, turn) = if self.is_turned {
            let (x, y) = (number(x + down), number(y));
            (x.clone(), y.clone(), format!(" transform=\"rotate(-90 {x} {y})\""))
        } else {
            (number(x), number(y + down), String::new())
        };
        // Writing to a String cannot fail.
        let _ = writeln!(
            out,
            "<text x=\"{x}\" y=\"{y}\" font-size=\"{}\" class=\"{}\"{anchor}{weight}{turn}>{}</text>",
            number(self.size),
            self.class,
            escaped(&self.content)
        );
    }
}

/// The room that a text takes along its line, at most.
pub(super) fn width(text: &str, size: f64) -> f64 {
    visible(text).chars().map(breadth).sum::<f64>() * size
}

/// The room of one character, as a multiple of the font size: that of Helvetica and Arial, but never
/// less than the average of a wide font.
fn breadth(letter: char) -> f64 {
    match letter {
        'W' | '@' | '%' | '…' => 1.02,
        'M' | 'm' => 0.85,
        'G' | 'O' | 'Q' => 0.79,
        'C' | 'D' | 'H' | 'N' | 'R' | 'U' | 'w' => 0.73,
        'A' | 'B' | 'E' | 'K' | 'P' | 'S' | 'V' | 'X' | 'Y' | '&' => 0.68,
        '\0'..='\u{2ff}' => 0.62,
        '\u{300}'..='\u{10ff}' | '\u{2000}'..='\u{206f}' => 0.85,
        _ => 1.4,
    }
}

/// The text as it is shown, cut if it is too long for its room.
pub(super) fn cut(text: &str, size: f64, room: f64) -> String {
    let text = visible(text);
    if width(&text, size) <= room {
        return text.into_owned();
    }
    let mut left = room / size - breadth('…');
    let fits = |letter: &char| {
        left -= breadth(*letter);
        left >= 0.0
    };
    let start: String = text.chars().take_while(fits).collect();
    format!("{}…", start.trim_end())
}

/// A number with at most one digit after the point.
pub(super) fn number(value: f64) -> String {
    let text = format!("{value:.1}");
    let short = text.strip_suffix(".0").unwrap_or(&text);
    if short == "-0" { "0".to_owned() } else { short.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_is_cut_to_its_room() {
        assert_eq!(cut("short", 10.0, 31.0), "short");
        assert_eq!(cut("a longer one", 10.0, 31.0), "a l…");
        for room in [10.0, 20.0, 50.0, 80.0] {
            for text in
                ["a longer one", "試験試験試験試験", "\u{1b}\u{1b}\u{1b}\u{1b}", "שלום שלום שלום"]
            {
                assert!(width(&cut(text, 10.0, room), 10.0) <= room.max(14.0), "{text} {room}");
            }
        }
    }

    #[test]
    fn numbers_are_short() {
        assert_eq!([0.04, -0.04, 12.0, -3.25, 7.96].map(number), ["0", "0", "12", "-3.2", "8"]);
    }
}
