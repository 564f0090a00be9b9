//! The rule that makes C++ names of a design's names, the same in each C++ host.
//!
//! A name is kept as it is if possible. A character that C++ does not allow becomes `_u` and its code; a leading `_` or
//! digit gets an `n` before it; a word of `reserved.txt` (keywords, macros of the system's headers, names of our own)
//! gets a `_` after it, and so does a name that is already taken. Upper and lower case count as the same, because
//! libcluon's guards and some file systems do not distinguish them.

use std::collections::BTreeSet;
use std::sync::OnceLock;

use sensedsl_job::host::identifier;

const RESERVED: &str = include_str!("reserved.txt");

/// The reserved words.
fn reserved() -> &'static BTreeSet<&'static str> {
    static WORDS: OnceLock<BTreeSet<&str>> = OnceLock::new();
    WORDS.get_or_init(|| {
        let lines = RESERVED.lines().filter(|line| !line.starts_with('#'));
        lines.flat_map(str::split_whitespace).collect()
    })
}

/// Hands out names, each at most once.
pub(super) struct CppNames {
    /// The names taken, in lower case.
    taken: BTreeSet<String>,
}

impl CppNames {
    /// No names are taken yet.
    pub(super) fn new() -> Self {
        Self { taken: BTreeSet::new() }
    }

    /// The C++ name for `name`, which is then taken.
    pub(super) fn take(&mut self, name: &str) -> String {
        let mut identifier = identifier(name);
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
