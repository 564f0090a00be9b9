//! The rule that makes field names of a design's names; `runtime/read_record.m` has the same.
//!
//! A name is kept as it is if possible. A byte of it that MATLAB's names do not have becomes `_u` and its code; a leading
//! `_` or digit gets an `n` before it; a keyword gets a `_` after it, and so does a name that is already taken.

use std::collections::BTreeSet;

use sensedsl_diagnostics::visible;

const KEYWORDS: &str = "break case catch classdef continue do else elseif end for function global if otherwise parfor \
    persistent return spmd switch try until while";

/// Hands out the names of a board's devices, each at most once.
#[derive(Default)]
pub(super) struct Fields {
    taken: BTreeSet<String>,
}

impl Fields {
    /// The field for `name`, which is then taken.
    pub(super) fn take(&mut self, name: &str) -> String {
        let mut field = field(name);
        while !self.taken.insert(field.clone()) {
            field.push('_');
        }
        field
    }
}

/// The field for a name by itself.
pub(super) fn field(name: &str) -> String {
    if KEYWORDS.split_whitespace().any(|word| word == name) {
        return format!("{name}_");
    }
    let mut field = String::new();
    for byte in name.bytes() {
        if byte.is_ascii_alphanumeric() || byte == b'_' {
            field.push(char::from(byte));
        } else {
            field.push_str(&format!("_u{byte:x}"));
        }
    }
    if !field.starts_with(|first: char| first.is_ascii_alphabetic()) {
        field.insert(0, 'n');
    }
    field
}

/// A text as a literal on one line.
pub(super) fn literal(text: &str) -> String {
    format!("'{}'", plain(text).replace('\'', "''"))
}

/// A text on one line.
pub(super) fn plain(text: &str) -> String {
    visible(text).into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_stay_unless_they_cannot() {
        let mut fields = Fields::default();
        let given = [
            ("IRFront", "IRFront"),
            ("end", "end_"),
            ("end_", "end__"),
            ("_hidden", "n_hidden"),
            ("Größe", "Gr_uc3_ub6_uc3_u9fe"),
        ];
        for (name, expected) in given {
            assert_eq!(fields.take(name), expected);
        }
    }

    #[test]
    fn literals_stay_on_their_line() {
        assert_eq!(literal("it's\n°C"), "'it''s\\u{a}°C'");
    }
}
