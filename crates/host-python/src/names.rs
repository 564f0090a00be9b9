//! The names of a design in Python: those of [`Names`], without keywords and names of the language or of the package.
//! Names with `_` in front are the package's own.

use sensedsl_job::host::{Names, identifier};

/// Keywords, names of the language that the package uses, and names of its own.
const RESERVED: &str = "False None True and as assert async await break class continue def del elif else except \
    finally for from global if import in is lambda nonlocal not or pass raise return try while with yield match case \
    type bool bytes classmethod float int object property str tuple super print annotations dataclass DESIGN ClassVar \
    Tuple Board DeviceError Facts Health Item Message OtherFirmware STATUS Scaling Schema Stamp boards_of of_raw \
    of_shown to_pandas \
    FACTS at of outside raw stamp unit value";

/// The names that are left.
pub(super) fn names() -> Names {
    Names::without(RESERVED)
}

/// The name of a package: lower case, behind `sense_`.
pub(super) fn package(name: &str) -> String {
    format!("sense_{}", identifier(name).to_ascii_lowercase())
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
        let mut names = names();
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
