//! "Did you mean": the name that is most similar to a misspelled one.

/// A word longer than this is not a typing mistake.
const TYPED_MAX: usize = 64;

/// The least number of letters to insert, delete, replace or swap with their neighbour to turn one
/// word into the other, letter case ignored.
#[must_use]
pub fn distance(left: &str, right: &str) -> usize {
    strsim::osa_distance(&left.to_lowercase(), &right.to_lowercase())
}

/// A name as a file has to spell it: as it is if it is a word or a pin such as `P0.13`, otherwise between quotes.
#[must_use]
pub fn spelled(name: &str) -> String {
    let is_word = |word: &str| word.bytes().all(|one| one.is_ascii_alphanumeric() || one == b'_');
    let is_pin = |(port, number): (&str, &str)| {
        port.starts_with(['P', 'p'])
            && !number.is_empty()
            && port.bytes().skip(1).chain(number.bytes()).all(|one| one.is_ascii_digit())
    };
    let starts = name.starts_with(|one: char| one.is_ascii_alphabetic());
    if starts && (is_word(name) || name.split_once('.').is_some_and(is_pin)) {
        return name.to_owned();
    }
    format!("\"{}\"", name.replace('\\', "\\\\").replace('"', "\\\""))
}

/// The name nearest to `typed`, the first among equals, if it is near enough to be a typing mistake:
/// at most one edit for every three letters, and at least one.
pub fn nearest<'a>(typed: &str, names: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let length = typed.chars().count();
    if length > TYPED_MAX {
        return None;
    }
    let edits = |name: &'a str| {
        let other = name.chars().count();
        let most = (other.max(length) / 3).max(1);
        // The difference in length is a cheap lower bound.
        let edits = (length.abs_diff(other) <= most).then(|| distance(typed, name))?;
        // Part of the word must be left: `a` is not a mistyped `b`.
        let keeps = edits == 0 || edits < length.min(other);
        (edits <= most && keeps).then_some((edits, name))
    };
    let near = names.into_iter().filter_map(edits);
    near.min_by_key(|(edits, _)| *edits).map(|(_, name)| name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances() {
        let cases = [
            ("", "", 0),
            ("", "abc", 3),
            ("abc", "", 3),
            ("sensor", "Sensor", 0),
            ("sensr", "sensor", 1),
            ("snesor", "sensor", 1),
            ("kitten", "sitting", 3),
            ("dealy", "delay", 1),
        ];
        for (left, right, expected) in cases {
            assert_eq!(distance(left, right), expected, "{left} {right}");
            assert_eq!(distance(right, left), expected, "{right} {left}");
        }
    }

    #[test]
    fn names_are_spelled_as_a_file_has_to() {
        let cases = [
            ("LED", "LED"),
            ("P0.13", "P0.13"),
            ("CN7.3", "\"CN7.3\""),
            ("5V", "\"5V\""),
            ("a \"b\"", "\"a \\\"b\\\"\""),
        ];
        for (name, expected) in cases {
            assert_eq!(spelled(name), expected);
        }
    }

    #[test]
    fn near_names_are_found_and_far_ones_not() {
        let names = ["analog", "i2c", "icu", "encoder"];
        assert_eq!(nearest("anlaog", names), Some("analog"));
        assert_eq!(nearest("I2C", names), Some("i2c"));
        assert_eq!(nearest("encdr", names), Some("encoder"));
        assert_eq!(nearest("bluetooth", names), None);
        assert_eq!(nearest("", names), None);
    }

    #[test]
    fn only_typing_mistakes_are_corrected() {
        let words = ["sensor", "actuator", "link", "a"];
        assert_eq!(nearest("sensr", words), Some("sensor"));
        assert_eq!(nearest("Actuater", words), Some("actuator"));
        assert_eq!(nearest("pin", words), None);
        assert_eq!(nearest("b", words), None);
        assert_eq!(nearest("motor", words), None);
    }
}
