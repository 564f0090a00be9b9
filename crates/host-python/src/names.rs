//! The rule that makes Python names of a design's names.
//!
//! A name is kept as it is if possible. A character that Python's names of this package do not have becomes `_u` and its
//! code; a leading `_` or digit gets an `n` before it, because names with `_` are the package's own; a keyword, a name
//! of the language or of the package gets a `_` after it, and so does a name that is already taken.

use std::collections::BTreeSet;

/// Keywords, names of the language that the package uses, and names of its own.
const RESERVED: &str = "False None True and as assert async await break class continue def del elif else except \
    finally for from global if import in is lambda nonlocal not or pass raise return try while with yield match case \
    type bool bytes classmethod float int object property str tuple super print annotations dataclass DESIGN ClassVar \
    Tuple Board DeviceError Facts Health Item Message OtherFirmware STATUS Scaling Schema Stamp boards_of of_raw \
    of_shown to_pandas \
    FACTS at of outside raw stamp unit value";

/// Hands out names, each at most once.
pub(super) struct PythonNames {
    taken: BTreeSet<String>,
}

impl PythonNames {
    /// Only the reserved names are taken.
    pub(super) fn new() -> Self {
        Self { taken: RESERVED.split_whitespace().map(str::to_owned).collect() }
    }

    /// The Python name for `name`, which is then taken.
    pub(super) fn take(&mut self, name: &str) -> String {
        let mut identifier = plain(name);
        while !self.taken.insert(identifier.clone()) {
            identifier.push('_');
        }
        identifier
    }
}

/// The name of a package: lower case, behind `sense_`.
pub(super) fn package(name: &str) -> String {
    format!("sense_{}", plain(name).to_ascii_lowercase())
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
    for character in text.chars() {
        match character {
            '"' | '\\' => out.extend(['\\', character]),
            ' '..='~' => out.push(character),
            other if u32::from(other) < 0x1_0000 => {
                out.push_str(&format!("\\u{:04x}", u32::from(other)));
            }
            other => out.push_str(&format!("\\U{:08x}", u32::from(other))),
        }
    }
    out.push('"');
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_stay_unless_they_cannot() {
        let mut names = PythonNames::new();
        let given = [
            ("IRFront", "IRFront"),
            ("lambda", "lambda_"),
            ("lambda_", "lambda__"),
            ("Board", "Board_"),
            ("irfront", "irfront"),
            ("_hidden", "n_hidden"),
            ("Größe", "Gr_uf6_udfe"),
        ];
        for (name, expected) in given {
            assert_eq!(names.take(name), expected);
        }
        assert_eq!(package("Miniature-Car"), "sense_miniature_u2dcar");
    }

    #[test]
    fn literals_stay_on_their_line() {
        assert_eq!(literal("a\"\\\n°😀"), "\"a\\\"\\\\\\u000a\\u00b0\\U0001f600\"");
    }
}
