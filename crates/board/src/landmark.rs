//! The buttons and LEDs of a board: what a person looks for on it, and where it is.
//!
//! Those that all boards of a form have are in the form's file, those of one board in its table, as
//! `# buttons = B1 6.1 122.3; B2 63.9 122.3` and `# leds = LD1 24.1 30.2`.

use serde::Deserialize;

/// A button or an LED.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Landmark {
    /// Which of them.
    pub kind: LandmarkKind,
    /// The name as in the column `Onboard`, or as printed: `LD2`, `RESET`.
    pub name: String,
    /// Where its middle is: x and y from the upper left corner of the form's outline.
    pub at_mm: [f64; 2],
}

/// The kinds of landmarks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum LandmarkKind {
    /// A button that is pressed.
    Button,
    /// A light of one colour or of several.
    Led,
}

/// The farthest from the corner of a board that a landmark is understood to be.
const DISTANCE_MAX_MM: f64 = 1_000.0;

impl LandmarkKind {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::Button, Self::Led];

    /// The key of the line that lists them in a table.
    #[must_use]
    pub const fn property(self) -> &'static str {
        match self {
            Self::Button => "buttons",
            Self::Led => "leds",
        }
    }

    /// The kind that a line with this key lists.
    #[must_use]
    pub fn of_property(key: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.property().eq_ignore_ascii_case(key))
    }

    /// What it is called in a text.
    #[must_use]
    pub const fn word(self) -> &'static str {
        match self {
            Self::Button => "button",
            Self::Led => "LED",
        }
    }
}

impl Landmark {
    /// Whether an on-board part of a table is this one: `LED LD2` is `LD2`.
    #[must_use]
    pub fn is_part(&self, part: &str) -> bool {
        let before =
            part.len().checked_sub(self.name.len()).and_then(|at| part.split_at_checked(at));
        before.is_some_and(|(before, name)| {
            name.eq_ignore_ascii_case(&self.name) && (before.is_empty() || before.ends_with(' '))
        })
    }
}

/// Reads the value of a table's line: names, each with x and y in millimetres, separated by `;`.
///
/// # Errors
///
/// The first entry that is not a name and two numbers.
pub fn parse(kind: LandmarkKind, list: &str) -> Result<Vec<Landmark>, &str> {
    let entries = list.split(';').map(str::trim).filter(|entry| !entry.is_empty());
    entries.map(|entry| one(kind, entry).ok_or(entry)).collect()
}

fn one(kind: LandmarkKind, entry: &str) -> Option<Landmark> {
    let (rest, y) = entry.rsplit_once(char::is_whitespace)?;
    let (name, x) = rest.trim_end().rsplit_once(char::is_whitespace)?;
    let name = name.trim_end();
    let number = |text: &str| {
        text.parse().ok().filter(|mm: &f64| (-DISTANCE_MAX_MM..=DISTANCE_MAX_MM).contains(mm))
    };
    Some(Landmark { kind, name: name.to_owned(), at_mm: [number(x)?, number(y)?] })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_are_names_with_places() {
        let read = |list| {
            let found = parse(LandmarkKind::Led, list)?;
            Ok::<_, &str>(found.into_iter().map(|one| (one.name, one.at_mm)).collect::<Vec<_>>())
        };
        assert_eq!(
            read(" LD1 24.1 30; RGB LED  -1 2.5 ;"),
            Ok(vec![("LD1".into(), [24.1, 30.0]), ("RGB LED".into(), [-1.0, 2.5])])
        );
        assert_eq!(read(""), Ok(vec![]));
        for wrong in ["LD1", "LD1 3", "3 4", "LD1 3 x", "LD1 3 nan", "LD1 3 1e9"] {
            assert_eq!(read(wrong), Err(wrong));
        }
    }

    #[test]
    fn parts_are_known_by_their_names() {
        let named =
            |name: &str| Landmark { kind: LandmarkKind::Led, name: name.into(), at_mm: [0.0, 0.0] };
        assert!(named("LD2").is_part("LED LD2") && named("LED").is_part("LED"));
        assert!(named("NeoPixel").is_part("neopixel"));
        assert!(!named("LD2").is_part("LED LD21") && !named("D2").is_part("LED LD2"));
        assert!(!named("Ä").is_part("LED ä!") && !named("LED LD2").is_part("LD2"));
    }
}
