//! The rule that makes C names of a design's names.
//!
//! A name is kept as it is if possible. A character that C does not allow becomes `_u` and its code; a leading `_` or
//! digit gets an `n` before it. Every name that is printed has the design and the board in front, or `on_`, so that no
//! keyword and no macro is hit. No board's name is the beginning of another's up to a `_`.

use std::collections::BTreeSet;

/// Hands out the names of boards.
pub(super) struct Prefixes {
    design: String,
    taken: Vec<String>,
}

impl Prefixes {
    /// Those of a design.
    pub(super) fn new(design: &str) -> Self {
        let mut design = plain(design);
        // What the runtime has begins with `sensedsl_`.
        if design.starts_with("sensedsl") {
            design.insert(0, 'n');
        }
        Self { design, taken: Vec::new() }
    }

    /// What stands before each name of a board; upper and lower case count as the same, as in some file systems.
    pub(super) fn take(&mut self, board: &str) -> String {
        let mut board = plain(board);
        let begins = |one: &str, other: &str| format!("{one}_").starts_with(&format!("{other}_"));
        while self.taken.iter().any(|other| {
            let lower = board.to_ascii_lowercase();
            begins(&lower, other) || begins(other, &lower)
        }) {
            board.insert(0, 'b');
        }
        self.taken.push(board.to_ascii_lowercase());
        format!("{}_{board}", self.design)
    }
}

/// Hands out the names of a board's devices, each at most once.
#[derive(Default)]
pub(super) struct CNames {
    taken: BTreeSet<String>,
}

impl CNames {
    /// The C name for `name`, which is then taken.
    pub(super) fn take(&mut self, name: &str) -> String {
        let mut identifier = plain(name);
        while !self.taken.insert(identifier.clone()) {
            identifier.push('_');
        }
        identifier
    }
}

fn plain(name: &str) -> String {
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

/// A text as a literal, in ASCII and on one line.
pub(super) fn literal(text: &str) -> String {
    let mut out = String::from("\"");
    for byte in text.bytes() {
        match byte {
            // Two question marks may begin a trigraph.
            b'"' | b'\\' | b'?' => out.extend(['\\', char::from(byte)]),
            b' '..=b'~' => out.push(char::from(byte)),
            other => out.push_str(&format!("\\{other:03o}")),
        }
    }
    out.push('"');
    out
}

/// A text that stays within its comment and its line.
pub(super) fn comment(text: &str) -> String {
    let mut out = String::new();
    for character in text.chars() {
        let closes =
            matches!((out.chars().next_back(), character), (Some('*'), '/') | (Some('/'), '*'));
        let is_trigraph = character == '?' && out.ends_with('?');
        if closes || is_trigraph {
            out.push(' ');
        }
        out.push(if character.is_control() || character == '\\' { ' ' } else { character });
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_stay_unless_they_cannot() {
        let mut names = CNames::default();
        let given = [
            ("IRFront", "IRFront"),
            ("default", "default"),
            ("_hidden", "n_hidden"),
            ("n_hidden", "n_hidden_"),
            ("Größe", "Gr_uf6_udfe"),
        ];
        for (name, expected) in given {
            assert_eq!(names.take(name), expected);
        }
    }

    #[test]
    fn no_board_begins_another() {
        let mut prefixes = Prefixes::new("sensedsl");
        let given = [
            ("Rover", "nsensedsl_Rover"),
            ("rover", "nsensedsl_brover"),
            ("Rover_value", "nsensedsl_bbRover_value"),
            ("Other", "nsensedsl_Other"),
        ];
        for (name, expected) in given {
            assert_eq!(prefixes.take(name), expected);
        }
    }

    #[test]
    fn texts_stay_in_their_place() {
        assert_eq!(literal("a\"\\\n°??/"), "\"a\\\"\\\\\\012\\302\\260\\?\\?/\"");
        assert_eq!(comment("*/ int x; /* a\\\nb ??/"), "* / int x; / * a  b ? ?/");
    }
}
