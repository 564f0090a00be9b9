//! What is said of a property: its name, what it takes, what it means.

use sensedsl_wire::Direction;

use super::takes::Takes;

/// What a property means.
#[derive(Clone, Copy, Debug)]
pub struct Meaning {
    /// Its name.
    pub name: &'static str,
    /// What it takes.
    pub takes: Takes,
    /// What it is if it is not there, in Markdown; empty if nothing.
    pub default: &'static str,
    /// One or two sentences, in Markdown.
    pub text: &'static str,
    /// A line with it.
    pub example: &'static str,
    /// The only direction of values that it is for, if it is not for both.
    pub only: Option<Direction>,
}

impl Meaning {
    pub(crate) const fn new(
        (name, takes): (&'static str, Takes),
        default: &'static str,
        text: &'static str,
        example: &'static str,
    ) -> Self {
        Self { name, takes, default, text, example, only: None }
    }

    /// The same for values of one direction only.
    pub(crate) const fn only(self, direction: Direction) -> Self {
        Self { only: Some(direction), ..self }
    }

    /// Whether there must be one.
    #[must_use]
    pub fn is_required(&self) -> bool {
        self.default == REQUIRED
    }
}

/// The default of a property that must be there.
pub(crate) const REQUIRED: &str = "required";

/// The first of each pair: the words that a reader knows.
pub(crate) fn first<T>(pairs: &[(&'static str, T)]) -> Vec<&'static str> {
    pairs.iter().map(|pair| pair.0).collect()
}
