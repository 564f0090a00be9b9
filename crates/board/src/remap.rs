//! Remap blocks: on some MCUs the peripheral, not the pin, decides which pins its signals are on.
//!
//! On STM32F1, a register field for each peripheral chooses one of a few blocks of pins, so all
//! signals of the peripheral that are used must be in one block. A usage lists the blocks of its
//! peripheral that it is in: `TIM2_CH1#0|2`. The pads of a SERCOM on SAM D that go together are
//! blocks as well.

use std::fmt;

/// The highest block number.
const LAST: u8 = 15;

/// The blocks that have a signal on a pin; never empty.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Blocks(u16);

impl Blocks {
    /// Reads numbers from 0 to 15, separated by `|`.
    #[must_use]
    pub fn parse(text: &str) -> Option<Self> {
        let bit = |number: &str| match number.as_bytes() {
            [digit @ b'0'..=b'9'] => Some(1_u16 << (digit - b'0')),
            [b'1', digit @ b'0'..=b'5'] => Some(1_u16 << (10 + digit - b'0')),
            _ => None,
        };
        text.split('|').try_fold(0, |bits, number| Some(bits | bit(number)?)).map(Self)
    }

    /// The signal and the blocks of a usage such as `TIM2_CH1#0|2`.
    #[must_use]
    pub fn split(usage: &str) -> (&str, Option<Self>) {
        match usage.split_once('#') {
            Some((signal, blocks)) => (signal, Self::parse(blocks)),
            None => (usage, None),
        }
    }

    /// The blocks that are in both sets.
    #[must_use]
    pub fn and(self, other: Self) -> Option<Self> {
        let bits = self.0 & other.0;
        (bits != 0).then_some(Self(bits))
    }

    /// The set with only the lowest block.
    #[must_use]
    pub fn lowest(self) -> Self {
        Self(1 << self.first())
    }

    /// The number of the lowest block.
    #[must_use]
    pub fn first(self) -> u8 {
        u8::try_from(self.0.trailing_zeros()).unwrap_or(LAST).min(LAST)
    }

    fn has(self, number: u8) -> bool {
        self.0 & (1 << number) != 0
    }
}

/// Whether sets of these that agree in pairs always agree all together, whichever are chosen. By a
/// theorem of Berge's, it is enough to check three blocks at a time: all sets with two of them must
/// have one block in common.
#[must_use]
pub fn agree_by_pairs(sets: &[Blocks]) -> bool {
    let triples = (0..=LAST).flat_map(|a| (a + 1..=LAST).map(move |b| (a, b)));
    let mut triples = triples.flat_map(|(a, b)| (b + 1..=LAST).map(move |c| [a, b, c]));
    triples.all(|triple| {
        let touching = |set: &&Blocks| triple.iter().filter(|block| set.has(**block)).count() >= 2;
        sets.iter().filter(touching).fold(u16::MAX, |common, set| common & set.0) != 0
    })
}

impl fmt::Display for Blocks {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut separator = "";
        for number in (0..=LAST).filter(|number| self.has(*number)) {
            write!(f, "{separator}{number}")?;
            separator = "|";
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn blocks(text: &str) -> Blocks {
        Blocks::parse(text).unwrap()
    }

    #[test]
    fn blocks_are_read_and_written() {
        for text in ["0", "3", "0|2", "1|3|7", "9|10|15"] {
            assert_eq!(blocks(text).to_string(), text);
        }
        assert_eq!(blocks("2|0|2").to_string(), "0|2");
        for text in ["", "16", "20", "0|", "|1", "a", "01", "0,1", "-1"] {
            assert_eq!(Blocks::parse(text), None, "{text}");
        }
    }

    #[test]
    fn blocks_agree() {
        assert_eq!(blocks("0|2").and(blocks("2|3")), Some(blocks("2")));
        assert_eq!(blocks("0|2").and(blocks("1|3")), None);
        assert_eq!(blocks("2|3").lowest(), blocks("2"));
        assert_eq!(blocks("2|3").first(), 2);
    }

    #[test]
    fn pairs_are_enough_for_some_sets() {
        let sets = |texts: &[&str]| texts.iter().map(|text| blocks(text)).collect::<Vec<_>>();
        assert!(agree_by_pairs(&sets(&[])));
        assert!(agree_by_pairs(&sets(&["0|2", "1|3", "0|1", "2|3"])));
        assert!(agree_by_pairs(&sets(&["0|1", "0", "1", "3"])));
        assert!(!agree_by_pairs(&sets(&["0|1", "1|2", "0|2"])));
    }
}
