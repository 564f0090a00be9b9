//! Parts that measure nothing until they are woken, as their data sheets say.
//!
//! For a driver of the library, `sleep.csv` has the register that wakes the part, the bits that count, the register's
//! value after power-up, and whether the part is awake while the bits are clear or while one of them is set. It is
//! written from the data sheets and knows nothing of what the drivers write. A part that is not in the table gives
//! values without setup.

use std::collections::BTreeMap;

const TABLE: &str = include_str!("sleep.csv");

/// The register bits that wake a part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Sleep {
    register: u16,
    mask: u8,
    reset: u8,
    is_awake_when_set: bool,
}

impl Sleep {
    /// The entry of a driver's part.
    pub(crate) fn of(driver: &str) -> Option<Self> {
        TABLE.lines().skip(1).find_map(|line| {
            let mut cells = line.split(',');
            if cells.next() != Some(driver) {
                return None;
            }
            let mut number =
                || u16::from_str_radix(cells.next()?.trim_start_matches("0x"), 16).ok();
            let (register, mask, reset) = (number()?, number()?, number()?);
            Some(Self {
                register,
                mask: u8::try_from(mask).ok()?,
                reset: u8::try_from(reset).ok()?,
                is_awake_when_set: cells.next() == Some("set"),
            })
        })
    }

    /// Whether the part sleeps after these registers were written.
    pub(crate) fn is_asleep(&self, written: &BTreeMap<u16, u8>) -> bool {
        let bits = written.get(&self.register).copied().unwrap_or(self.reset) & self.mask;
        (bits != 0) != self.is_awake_when_set
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_line_is_a_part_that_sleeps_at_first() {
        for line in TABLE.lines().skip(1) {
            let driver = line.split(',').next().unwrap_or_default();
            let sleep = Sleep::of(driver);
            assert!(sleep.is_some_and(|sleep| sleep.is_asleep(&BTreeMap::new())), "{line}");
        }
        assert_eq!(Sleep::of("driver"), None);
    }
}
