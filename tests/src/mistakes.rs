//! Mistakes that tests put into generated files. In: a file of `tests/mistakes`. Out: the mistakes in its order.
//!
//! A line is a mistake: its name, the place, and what is replaced: `` name | place | `find` => `with`, … ``. A
//! heading in brackets is the place of the lines below it. Names of places may be several, separated by spaces. A line
//! without a name adds a place to the mistake above, a line in parentheses the reason why nothing notices it; a line may
//! begin with what is replaced. A star after the name: it survived once. `\n` is a line end.

use crate::text;

/// A mistake.
#[derive(Clone, Debug)]
pub struct Mistake {
    pub what: String,
    /// Whether the check that notices it was written because of it.
    pub has_survived: bool,
    /// Why nothing notices it; empty if something does.
    pub why: String,
    pub places: Vec<Place>,
}

/// A file, or another text, and what is replaced in it.
#[derive(Clone, Debug)]
pub struct Place {
    pub name: String,
    pub swaps: Vec<(String, String)>,
}

/// The mistakes in a file of `tests/mistakes`.
#[must_use]
pub fn mistakes(file: &str) -> Vec<Mistake> {
    let mut all: Vec<Mistake> = Vec::new();
    let mut heading = "";
    let text = text(&format!("tests/mistakes/{file}"));
    for line in text.lines().filter(|line| !line.is_empty() && !line.starts_with('#')) {
        if let Some(place) = line.strip_prefix('[') {
            heading = place.trim_end_matches(']');
            continue;
        }
        let cells = line.split_once(" | ").filter(|_| !line.starts_with('`'));
        let (what, rest) = cells.unwrap_or((line, if line.starts_with('`') { line } else { "" }));
        if !what.starts_with(' ') {
            let (name, star) = what.strip_suffix(" *").map_or((what, false), |name| (name, true));
            let (what, why) = (name.to_owned(), String::new());
            all.push(Mistake { what, has_survived: star, why, places: Vec::new() });
        }
        let own = all.last_mut().unwrap_or_else(|| panic!("{file}: {line}"));
        if let Some(why) = line.trim().strip_prefix('(') {
            own.why = why.trim_end_matches(')').to_owned();
        }
        let (places, changes) = match rest.split_once('`') {
            Some(("", _)) => (heading, rest),
            Some((places, _)) => (places, &rest[places.len()..]),
            None => ("", ""),
        };
        let swaps: Vec<_> = changes.split("`, `").filter_map(swap).collect();
        let place = |name: &str| Place { name: name.to_owned(), swaps: swaps.clone() };
        own.places.extend(places.trim_end_matches([' ', '|']).split_whitespace().map(place));
    }
    all
}

fn swap(text: &str) -> Option<(String, String)> {
    let plain = |text: &str| text.trim_matches('`').replace("\\n", "\n");
    text.split_once("` => `").map(|(find, with)| (plain(find), plain(with)))
}

impl Mistake {
    /// What is replaced in a place; empty if nothing is.
    #[must_use]
    pub fn swaps(&self, place: &str) -> &[(String, String)] {
        self.places.iter().find(|one| one.name == place).map_or(&[], |one| &one.swaps)
    }
}

impl Place {
    /// The text with the first occurrence replaced.
    #[must_use]
    #[track_caller]
    pub fn once(&self, text: &str) -> String {
        self.changed(text, |text, find, with| text.replacen(find, with, 1))
    }

    /// The text with all occurrences replaced.
    #[must_use]
    #[track_caller]
    pub fn everywhere(&self, text: &str) -> String {
        self.changed(text, |text, find, with| text.replace(find, with))
    }

    #[track_caller]
    fn changed(&self, text: &str, change: impl Fn(&str, &str, &str) -> String) -> String {
        let mut text = text.to_owned();
        for (find, with) in &self.swaps {
            assert!(text.contains(find), "{} has no `{find}`", self.name);
            text = change(&text, find, with);
        }
        text
    }
}
