//! The names of a design in Rust: those of [`Names`], without keywords and names of the language or of the crate.

use sensedsl_job::host::{Names, identifier};

/// Keywords, names of the language that the crate uses, and names of its own.
const RESERVED: &str = "Self abstract as async await become box break const continue crate default do dyn else enum \
    extern false final fn for gen if impl in let loop macro macro_rules match mod move mut override priv pub raw ref \
    return safe self static struct super trait true try type typeof union unsafe unsized use virtual where while yield \
    bool char f32 f64 i8 i16 i32 i64 i128 isize str u8 u16 u32 u64 u128 usize \
    AsMut AsRef Box Clone Copy Debug Default Display DoubleEndedIterator Drop Eq Err Error Fn FnMut FnOnce From FromIterator \
    Into IntoIterator Iterator None Ok Option Ord PartialEq PartialOrd Result Send Sized Some String Sync ToOwned \
    ToString TryFrom TryInto Unpin Vec \
    alloc core sensedsl sensedsl_host sensedsl_wire std device messages \
    AnyMessage Board BoardHealth Checksum Counts Decoder Device DeviceHealth EncodeError Event Facts Found Health \
    HealthFrame Item Link Messages Overstep Question Raw Received Refused Report ResetCause Scaling Schema Stamp State \
    Status Stream Table DESIGN ITEMS";

/// The names that are left.
pub(super) fn names() -> Names {
    Names::without(RESERVED)
}

/// The name of a crate, as its manifest has it: lower case, after `sense-`.
pub(super) fn package(name: &str) -> String {
    format!("sense-{}", identifier(name).to_ascii_lowercase().replace('_', "-"))
}

/// A text as a literal, in ASCII and on one line.
pub(super) fn literal(text: &str) -> String {
    let mut out = String::from("\"");
    for character in text.chars() {
        match character {
            '"' | '\\' => out.extend(['\\', character]),
            ' '..='~' => out.push(character),
            other => out.push_str(&format!("\\u{{{:x}}}", u32::from(other))),
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
            ("loop", "loop_"),
            ("loop_", "loop__"),
            ("Board", "Board_"),
            ("irfront", "irfront"),
            ("_hidden", "n_hidden"),
            ("Größe", "Gr_uf6_udfe"),
        ];
        for (name, expected) in given {
            assert_eq!(names.take(name), expected);
        }
        assert_eq!(package("Miniature-Car"), "sense-miniature-u2dcar");
    }

    #[test]
    fn literals_stay_on_their_line() {
        assert_eq!(literal("a\"\\\n°😀"), "\"a\\\"\\\\\\u{a}\\u{b0}\\u{1f600}\"");
    }
}
