//! One rule that makes C++ names of a design's names, the same in each C++ host.
//!
//! A name stays as it is. A character that C++ does not allow becomes `_u` and its code, a leading
//! `_` or digit gets an `n` before it, a word of `reserved.txt` (keywords, macros of the system's
//! headers, names of our own) a `_` behind it, and so does a name that would then be taken already,
//! upper and lower case being one: libcluon's guards and some file systems do not tell them apart.

use std::collections::BTreeSet;
use std::sync::OnceLock;

const RESERVED: &str = include_str!("reserved.txt");

/// The words of the list.
fn reserved() -> &'static BTreeSet<&'static str> {
    static WORDS: OnceLock<BTreeSet<&str>> = OnceLock::new();
    WORDS.get_or_init(|| {
        let lines = RESERVED.lines().filter(|line| !line.starts_with('#'));
        lines.flat_map(str::split_whitespace).collect()
    })
}

/// Hands out names, each at most once.
pub(super) struct CppNames {
    /// In lower case.
    taken: BTreeSet<String>,
}

impl CppNames {
    /// Nothing is taken yet.
    pub(super) fn new() -> Self {
        Self { taken: BTreeSet::new() }
    }

    /// The C++ name for `name`, taken from now on.
    pub(super) fn take(&mut self, name: &str) -> String {
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
        while reserved().contains(identifier.as_str())
            || !self.taken.insert(identifier.to_ascii_lowercase())
        {
            identifier.push('_');
        }
        identifier
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_stay_unless_they_cannot() {
        let mut names = CppNames::new();
        let given = [
            ("IRFront", "IRFront"),
            ("default", "default_"),
            ("default_", "default__"),
            ("ECHO", "ECHO_"),
            ("linux", "linux_"),
            ("irfront", "irfront_"),
            ("Decoder", "Decoder_"),
            ("_hidden", "n_hidden"),
            ("n_hidden", "n_hidden_"),
            ("Größe", "Gr_uf6_udfe"),
        ];
        for (name, expected) in given {
            assert_eq!(names.take(name), expected);
        }
    }
}
