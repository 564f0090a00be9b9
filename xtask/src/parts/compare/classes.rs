//! The reasons why two sources differ. In: the table of `differences.md`. Out: the class of a
//! difference.

use std::fmt;

use anyhow::{Context as _, Result, ensure};

/// The sources that have a fact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Side {
    Own,
    St,
    /// Both have it, and they disagree.
    Both,
}

/// A fact in which they differ.
#[derive(Clone, Debug)]
pub(crate) struct Difference {
    pub(crate) side: Side,
    pub(crate) part: String,
    pub(crate) pin: String,
    /// A usage, or `contact 23/22`.
    pub(crate) what: String,
}

impl Difference {
    pub(crate) fn is_usage(&self) -> bool {
        self.pin != "package" && !self.what.starts_with("contact ")
    }
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {} {} {}", self.side.word(), self.part, self.pin, self.what)
    }
}

impl Side {
    const fn word(self) -> &'static str {
        match self {
            Self::Own => "ours",
            Self::St => "ST",
            Self::Both => "both",
        }
    }
}

/// A row of the table: its patterns, how often they may match, and how often they did.
struct Class {
    side: String,
    /// The patterns, one of which must match.
    parts: Vec<String>,
    pins: Vec<String>,
    whats: Vec<String>,
    most: u64,
    found: u64,
}

/// All rows.
pub(crate) struct Classes(Vec<Class>);

impl Classes {
    /// Reads the rows `| side | parts | pins | what | at most | why |`.
    pub(crate) fn parse(text: &str) -> Result<Self> {
        let rows = text.lines().filter(|line| line.starts_with('|')).skip(2);
        let class = |row: &str| {
            let cells: Vec<&str> = row.trim_matches('|').split('|').map(str::trim).collect();
            let [side, parts, pins, whats, most, why] = cells.as_slice() else {
                anyhow::bail!("a row with other than six cells: {row}");
            };
            ensure!(why.len() > 20, "a class without an explanation: {row}");
            let patterns = |cell: &str| -> Vec<String> {
                cell.replace('`', "").split(' ').map(str::to_owned).collect()
            };
            Ok(Class {
                side: (*side).to_owned(),
                parts: patterns(parts),
                pins: patterns(pins),
                whats: patterns(whats),
                most: most.parse().with_context(|| row.to_owned())?,
                found: 0,
            })
        };
        Ok(Self(rows.map(class).collect::<Result<_>>()?))
    }

    /// Counts a difference in the first class that it matches; returns false if there is none.
    pub(crate) fn count(&mut self, difference: &Difference) -> bool {
        let fits = |patterns: &[String], text: &str| patterns.iter().any(|p| glob(p, text));
        let class = self.0.iter_mut().find(|class| {
            class.side == difference.side.word()
                && fits(&class.parts, &difference.part)
                && fits(&class.pins, &difference.pin)
                && fits(&class.whats, &difference.what)
        });
        class.map(|class| class.found += 1).is_some()
    }

    /// A line for each class.
    pub(crate) fn report(&self) -> Vec<String> {
        let line = |class: &Class| format!("{:>6} of {:>6}  {}", class.found, class.most, class);
        self.0.iter().map(line).collect()
    }

    /// The classes with more differences than allowed.
    pub(crate) fn grown(&self) -> Vec<String> {
        let grown = self.0.iter().filter(|class| class.found > class.most);
        grown.map(|class| format!("{class}: {} instead of {}", class.found, class.most)).collect()
    }
}

impl fmt::Display for Class {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [parts, pins, whats] = [&self.parts, &self.pins, &self.whats].map(|all| all.join(" "));
        write!(f, "{}: {parts} / {pins} / {whats}", self.side)
    }
}

/// Whether a pattern matches a text; `*` stands for any text.
fn glob(pattern: &str, text: &str) -> bool {
    match pattern.split_once('*') {
        None => pattern == text,
        Some((start, rest)) => text.strip_prefix(start).is_some_and(|tail| {
            let ends = tail.char_indices().map(|(at, _)| at).chain([tail.len()]);
            ends.filter_map(|at| tail.get(at..)).any(|tail| glob(rest, tail))
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TABLE: &str = "# T\n\n| side | parts | pins | what | at most | why |\n| --- | --- | --- | --- | --- | --- |\n\
        | ST | `STM32H7*` | `P*_C` | `*` | 1 | pads with a switch between them |\n";

    fn difference(side: Side, pin: &str) -> Difference {
        let (part, what) = ("STM32H743VITx".to_owned(), "SPI2_MISO".to_owned());
        Difference { side, part, pin: pin.to_owned(), what }
    }

    #[test]
    fn a_class_takes_what_fits_and_may_not_grow() {
        let mut classes = Classes::parse(TABLE).unwrap();
        assert!(!classes.count(&difference(Side::Own, "PC2_C")));
        assert!(!classes.count(&difference(Side::St, "PC2")));
        assert!(classes.count(&difference(Side::St, "PC2_C")));
        assert!(classes.grown().is_empty());
        assert!(classes.count(&difference(Side::St, "PC3_C")));
        assert_eq!(classes.grown().len(), 1);
    }

    #[test]
    fn a_class_without_a_reason_is_none() {
        assert!(Classes::parse(&TABLE.replace("pads with a switch between them", "?")).is_err());
    }

    #[test]
    fn stars_stand_for_any_text() {
        assert!(glob("*", "") && glob("A*C", "ABC") && glob("A*", "A") && !glob("A", "AB"));
        assert!(!glob("A*C", "AB") && glob("*B*", "ABC"));
    }
}
