//! The rule that makes C names of a design's names.
//!
//! Names are those of [`sensedsl_job::host::Names`], with nothing reserved: every name that is printed has the design and the board in front, or `on_`, so that no
//! keyword and no macro is hit. No board's name is the beginning of another's up to a `_`.

use sensedsl_job::host::identifier;

/// Hands out the names of boards.
pub(super) struct Prefixes {
    design: String,
    taken: Vec<String>,
}

impl Prefixes {
    /// Those of a design.
    pub(super) fn new(design: &str) -> Self {
        let mut design = identifier(design);
        // What the runtime has begins with `sensedsl_`.
        if design.starts_with("sensedsl") {
            design.insert(0, 'n');
        }
        Self { design, taken: Vec::new() }
    }

    /// What stands before each name of a board; upper and lower case count as the same, as in some file systems.
    pub(super) fn take(&mut self, board: &str) -> String {
        let mut board = identifier(board);
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
