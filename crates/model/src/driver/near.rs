//! What to propose for a driver that is not there: a name in; the name that was meant, or parts of the same family or
//! sort, out.
//!
//! A proposal that has nothing to do with the name is worse than none, so what is only similar in its letters counts
//! as a typing mistake, what shares the family's letters and its purpose as a similar part, and what shares neither is
//! looked for among the words that people use.

use sensedsl_diagnostics::{distance, nearest};

use super::library::search;
use super::{Driver, Drivers};
use crate::rule::names::folded;

/// Fewest letters that identify a part by the beginning of its name.
const BEGINNING_MIN: usize = 3;
/// Letters of a name without digits that identify a part when another word follows.
const TELLING_MIN: usize = 5;
/// Most parts that are proposed.
const SIMILAR_MAX: usize = 4;
/// Words that are in the names of parts of all sorts.
const COMMON_WORDS: &[&str] =
    &["sensor", "driver", "module", "controller", "digital", "analog", "board"];
/// A name with so many digits of the family's in common needs no common purpose.
const DIGITS_SHARED: usize = 2;

/// What an unknown name may stand for.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Near {
    /// The name, if it was misspelled.
    pub meant: Option<String>,
    /// Other parts of the same family, or of the sort that the name says: the most similar first.
    pub similar: Vec<String>,
}

impl Drivers {
    /// What an unknown name may stand for.
    pub(crate) fn near(&self, name: &str) -> Near {
        if let Some(meant) = self.meant(name) {
            return Near { meant: Some(meant.to_owned()), similar: Vec::new() };
        }
        let family = self.family(name);
        let similar = if family.is_empty() { sort(name) } else { family };
        Near { meant: None, similar }
    }

    /// The driver that a misspelled name may stand for. Tried in this order: the one with the
    /// nearest name, the first with a name that begins with it or that it begins with, the one with
    /// the nearest alias.
    pub(crate) fn meant(&self, name: &str) -> Option<&str> {
        let is_it = |other: &&str| is_misspelled(name, other);
        let near_name =
            || nearest(name, self.all().map(|one| one.name.value.as_str()).filter(is_it));
        // A word that begins with another letter is a different word (barometer, tachometer).
        let first = name.chars().next().map(|letter| letter.to_ascii_lowercase());
        let begins_so = |alias: &&str| alias.chars().next() == first;
        let near_alias = || {
            let aliases = self.all().flat_map(|one| one.aliases.iter().map(String::as_str));
            let near = nearest(name, aliases.filter(begins_so).filter(is_it))?;
            self.look_up(near).map(|one| one.name.value.as_str())
        };
        near_name().or_else(|| self.begins(name)).or_else(near_alias)
    }

    /// The first driver with a name that begins like this; otherwise the one whose name is the
    /// longest prefix of this one (`mpu6050_gyro`).
    fn begins(&self, name: &str) -> Option<&str> {
        let wanted = folded(name);
        let is_long = wanted.len() >= BEGINNING_MIN;
        let longer = self.folded_names().find(|(name, _)| is_long && name.starts_with(&wanted));
        let is_beginning = |(name, _): &(String, _)| {
            // Another digit makes another part: an ADXL3450 is not an ADXL345.
            let goes_on = wanted.strip_prefix(name.as_str()).and_then(|rest| rest.chars().next());
            // A word such as `led` begins names of quite other parts.
            let is_telling =
                name.len() >= TELLING_MIN || name.contains(|c: char| c.is_ascii_digit());
            let is_long = name.len() >= BEGINNING_MIN && is_telling;
            is_long && goes_on.is_some_and(|next| !next.is_ascii_digit())
        };
        let shorter =
            || self.folded_names().filter(is_beginning).max_by_key(|(name, _)| name.len());
        longer.or_else(shorter).map(|(_, driver)| driver.name.value.as_str())
    }

    /// All names, as they are compared, with their drivers.
    fn folded_names(&self) -> impl Iterator<Item = (String, &Driver)> {
        self.all().flat_map(|one| {
            let aliases = one.aliases.iter().map(String::as_str);
            let names = std::iter::once(one.name.value.as_str()).chain(aliases);
            names.map(move |name| (folded(name), one))
        })
    }

    /// Parts whose names begin with the same letters and as many of the same digits as any do. If
    /// only letters are shared, they must all be of one sort: `max` is a maker, `bme` a family.
    fn family(&self, name: &str) -> Vec<String> {
        let wanted = folded(name);
        let letters = wanted.chars().take_while(char::is_ascii_alphabetic).count();
        let is_part = wanted.is_ascii() && wanted.contains(|one: char| one.is_ascii_digit());
        if !is_part || letters + 1 < BEGINNING_MIN {
            return Vec::new();
        }
        for length in (letters.max(BEGINNING_MIN)..=wanted.len()).rev() {
            let Some(beginning) = wanted.get(..length) else { continue };
            let shares = |(name, _): &(String, _)| name.starts_with(beginning);
            let mut found: Vec<(usize, &str)> = Vec::new();
            for (name, driver) in self.folded_names().filter(shares) {
                let (edits, own) = (distance(&name, &wanted), driver.name.value.as_str());
                match found.iter_mut().find(|(_, other)| *other == own) {
                    Some(one) => one.0 = one.0.min(edits),
                    None => found.push((edits, own)),
                }
            }
            found.sort_by_key(|(edits, _)| *edits);
            let names: Vec<&str> = found.into_iter().map(|(_, name)| name).collect();
            let is_family = length >= letters + DIGITS_SHARED || are_of_one_sort(&names);
            if !names.is_empty() {
                let own = names.into_iter().take(SIMILAR_MAX).map(str::to_owned);
                return if is_family { own.collect() } else { Vec::new() };
            }
        }
        Vec::new()
    }
}

/// Whether one name may be a slip of the other. Two numbers of parts that differ in a digit are two parts, unless digits
/// are swapped or one is missing.
fn is_misspelled(name: &str, other: &str) -> bool {
    let digits = |name: &str| -> Vec<char> {
        let mut all: Vec<char> = name.chars().filter(char::is_ascii_digit).collect();
        all.sort_unstable();
        all
    };
    let (one, two) = (digits(name), digits(other));
    one.len() != two.len() || one == two
}

/// The lines of `search.csv`: words, and the drivers that they mean.
fn lines() -> impl Iterator<Item = (Vec<&'static str>, Vec<&'static str>)> {
    let lines = search().lines().skip(1).filter_map(|line| line.split_once(','));
    lines.map(|(words, drivers)| (words.split(' ').collect(), drivers.split(' ').collect()))
}

/// Whether the drivers stand together in a line of `search.csv`.
fn are_of_one_sort(names: &[&str]) -> bool {
    lines().any(|(_, drivers)| names.iter().all(|name| drivers.contains(name)))
}

/// The drivers of the sort that the words of a name say: `barometer`, `color_sensor`.
fn sort(name: &str) -> Vec<String> {
    let name = name.to_lowercase();
    let words: Vec<&str> = name
        .split(|letter: char| !letter.is_alphanumeric())
        .filter(|word| word.len() >= BEGINNING_MIN && !COMMON_WORDS.contains(word))
        .collect();
    let hits = |known: &[&str]| words.iter().filter(|word| known.contains(word)).count();
    let mut best: Option<(usize, Vec<&str>)> = None;
    for (known, drivers) in lines() {
        let count = hits(&known);
        if count > best.as_ref().map_or(0, |(most, _)| *most) {
            best = Some((count, drivers));
        }
    }
    let drivers = best.map(|(_, drivers)| drivers).unwrap_or_default();
    drivers.into_iter().take(SIMILAR_MAX).map(str::to_owned).collect()
}

/// A name as a block can have it, for a driver to begin with.
#[must_use]
pub fn identifier(name: &str) -> String {
    let letter =
        |one: char| if one.is_ascii_alphanumeric() { one.to_ascii_lowercase() } else { '_' };
    let plain: String = name.chars().take(40).map(letter).collect();
    if plain.starts_with(|one: char| one.is_ascii_alphabetic()) {
        plain
    } else {
        format!("my_{plain}")
    }
}
