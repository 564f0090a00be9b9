//! How texts look: the terminal's own sixteen colours and attributes, so that they suit light and dark themes alike.
//!
//! In: what a text is. Out: its style. Without colours (`NO_COLOR`) attributes and letters say the same.

use ratatui_core::style::{Color, Modifier, Style};

/// What a text is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Tone {
    Plain,
    Faint,
    Head,
    Good,
    Warning,
    Bad,
    Actuator,
    Key,
    /// A line of a plot, by its place among all.
    Line(usize),
}

/// The colours of lines: those that are seen on white and on black come first.
const LINES: [Color; 6] =
    [Color::Cyan, Color::Magenta, Color::Green, Color::Red, Color::Blue, Color::Yellow];

/// Whether there are colours.
#[derive(Clone, Copy, Debug)]
pub(super) struct Look {
    pub(super) has_colours: bool,
    /// Whether there are letters for bars and dots.
    pub(super) has_shapes: bool,
}

impl Look {
    pub(super) fn of(self, tone: Tone) -> Style {
        let (colour, modifier) = match tone {
            Tone::Plain => (None, Modifier::empty()),
            Tone::Faint => (None, Modifier::DIM),
            Tone::Head => (None, Modifier::BOLD),
            Tone::Good => (Some(Color::Green), Modifier::empty()),
            Tone::Warning => (Some(Color::Yellow), Modifier::BOLD),
            Tone::Bad => (Some(Color::Red), Modifier::BOLD),
            Tone::Actuator => (Some(Color::Cyan), Modifier::empty()),
            Tone::Key => (Some(Color::Blue), Modifier::BOLD),
            Tone::Line(place) => (LINES.get(place % LINES.len()).copied(), Modifier::empty()),
        };
        let style = Style::new().add_modifier(modifier);
        match colour.filter(|_| self.has_colours) {
            Some(colour) => style.fg(colour),
            None => style,
        }
    }
}
