//! "Did you mean": the candidate that is most similar to a misspelled word.

/// The least number of letters to insert, delete, replace or swap with their neighbour to turn one
/// word into the other, letter case ignored.
#[must_use]
pub fn distance(left: &str, right: &str) -> usize {
    strsim::osa_distance(&left.to_lowercase(), &right.to_lowercase())
}

/// The candidate nearest to `word`, the first among equals, if it is near enough to be a slip: at
/// most one edit for every three letters, and at least one.
#[must_use]
pub fn nearest<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let length = word.chars().count();
    let limit = (length / 3).max(1);
    let edits = |candidate: &'a str| {
        let other = candidate.chars().count();
        // The difference in length is a lower bound that costs nothing.
        let edits = (length.abs_diff(other) <= limit).then(|| distance(word, candidate))?;
        // A slip keeps something of the word: `a` is no slip for `b`.
        (edits <= limit && edits < length.min(other)).then_some((edits, candidate))
    };
    let near = candidates.into_iter().filter_map(edits);
    near.min_by_key(|(edits, _)| *edits).map(|(_, candidate)| candidate)
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
    fn only_slips_are_suggested() {
        let words = ["sensor", "actuator", "link", "a"];
        assert_eq!(nearest("sensr", words), Some("sensor"));
        assert_eq!(nearest("Actuater", words), Some("actuator"));
        assert_eq!(nearest("pin", words), None);
        assert_eq!(nearest("b", words), None);
        assert_eq!(nearest("motor", words), None);
    }
}
