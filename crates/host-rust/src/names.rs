//! The rule that makes Rust names of a design's names.
//!
//! A name is kept as it is if possible. A character that Rust's names of this crate do not have becomes `_u` and its
//! code; a leading `_` or digit gets an `n` before it; a keyword, a name of the language or of the crate gets a `_`
//! after it, and so does a name that is already taken.

use std::collections::BTreeSet;

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

/// Hands out names, each at most once.
pub(super) struct RustNames {
    taken: BTreeSet<String>,
}

impl RustNames {
    /// Only the reserved names are taken.
    pub(super) fn new() -> Self {
        Self { taken: RESERVED.split_whitespace().map(str::to_owned).collect() }
    }

    /// The Rust name for `name`, which is then taken.
    pub(super) fn take(&mut self, name: &str) -> String {
        let mut identifier = plain(name);
        while !self.taken.insert(identifier.clone()) {
            identifier.push('_');
        }
        identifier
    }
}

/// The name of a crate, as its manifest has it: lower case, after `sense-`.
pub(super) fn package(name: &str) -> String {
    format!("sense-{}", plain(name).to_ascii_lowercase().replace('_', "-"))
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
        let mut names = RustNames::new();
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
