//! The rule that makes names of a programming language of a design's names, as far as it is the same in all of them.
//!
//! A name is kept as it is if possible. A character that is no letter or digit of ASCII becomes `_u` and its code; a
//! leading `_` or digit gets an `n` before it; what is reserved or already taken gets a `_` after it. What a language
//! reserves is the host's.

use std::collections::BTreeSet;

/// Hands out names, each at most once.
#[derive(Clone, Debug, Default)]
pub struct Names {
    taken: BTreeSet<String>,
}

impl Names {
    /// Names besides those that are reserved, which stand with spaces between them.
    #[must_use]
    pub fn without(reserved: &str) -> Self {
        Self { taken: reserved.split_whitespace().map(str::to_owned).collect() }
    }

    /// The name for `name`, which is then taken.
    pub fn take(&mut self, name: &str) -> String {
        let mut identifier = identifier(name);
        while !self.taken.insert(identifier.clone()) {
            identifier.push('_');
        }
        identifier
    }
}

/// The name as an identifier, reserved or not.
#[must_use]
pub fn identifier(name: &str) -> String {
    let mut identifier = String::new();
    for character in name.chars() {
        if character.is_ascii_alphanumeric() || character == '_' {
            identifier.push(character);
        } else {
            identifier.push_str(&format!("_u{:x}", u32::from(character)));
        }
    }
    if !identifier.starts_with(|first: char| first.is_ascii_alphabetic()) {
        identifier.insert(0, 'n');
    }
    identifier
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_stay_unless_they_cannot() {
        let mut names = Names::without("loop Board");
        let given = [
            ("IRFront", "IRFront"),
            ("loop", "loop_"),
            ("loop_", "loop__"),
            ("Board", "Board_"),
            ("irfront", "irfront"),
            ("_hidden", "n_hidden"),
            ("n_hidden", "n_hidden_"),
            ("Größe", "Gr_uf6_udfe"),
        ];
        for (name, expected) in given {
            assert_eq!(names.take(name), expected);
        }
    }
}
