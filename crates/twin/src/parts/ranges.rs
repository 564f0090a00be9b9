//! Parts whose registers determine how many counts they give for a unit, and how often they measure.
//!
//! For each reading of a driver of the library, `ranges.csv` has the register that sets its range, the bits that count,
//! the register's value after power-up, and the counts for one unit under each code. A code that is not in the list
//! gives 0: the data sheet reserves it, or the part does not measure with it. `rates.csv` has measurements a second in
//! the same form. Both are written from the data sheets. The codes that a board writes are compared with those that the
//! design says it writes: if they are the same, the part gives the numbers that the design's `scale` expects.

use std::collections::BTreeMap;

use sensedsl_model::protocol::{InitStep, Protocol};

use crate::arith::nanoseconds;

const RANGES: &str = include_str!("ranges.csv");
const RATES: &str = include_str!("rates.csv");
/// The name that stands for all readings of a driver.
const ALL: &str = "*";

/// A register, and the meaning of each of its codes.
#[derive(Clone, Debug, PartialEq)]
struct Setting {
    register: u16,
    mask: u8,
    reset: u8,
    codes: Vec<(u8, f64)>,
}

/// The settings for a reading, and the register values that the design writes.
#[derive(Clone, Debug, Default)]
pub(crate) struct Ranges {
    ranges: Vec<Setting>,
    rates: Vec<Setting>,
    planned: BTreeMap<u16, u8>,
}

impl Setting {
    /// The settings for a reading in a table.
    fn of(table: &str, driver: &str, reading: Option<&str>) -> Vec<Self> {
        let own = table.lines().skip(1).filter_map(|line| {
            let mut cells = line.split(',');
            let is_driver = cells.next() == Some(driver);
            let name = cells.next()?;
            let is_own = is_driver && (name == ALL || reading.is_none_or(|own| own == name));
            is_own.then(|| Self::read(cells))?
        });
        own.collect()
    }

    fn read<'a>(mut cells: impl Iterator<Item = &'a str>) -> Option<Self> {
        let mut number = || hexadecimal(cells.next()?);
        let (register, mask, reset) = (number()?, number()?, number()?);
        let code = |text: &str| {
            let (code, value) = text.split_once('=')?;
            Some((u8::try_from(hexadecimal(code)?).ok()?, value.parse().ok()?))
        };
        let codes = cells.next()?.split(' ').map(code).collect::<Option<Vec<(u8, f64)>>>()?;
        let (mask, reset) = (u8::try_from(mask).ok()?, u8::try_from(reset).ok()?);
        Some(Self { register, mask, reset, codes })
    }

    /// The setting in the registers; 0 for an unknown code.
    fn value(&self, written: &BTreeMap<u16, u8>) -> f64 {
        let code = written.get(&self.register).copied().unwrap_or(self.reset) & self.mask;
        self.codes.iter().find(|(own, _)| *own == code).map_or(0.0, |(_, value)| *value)
    }
}

fn hexadecimal(text: &str) -> Option<u16> {
    u16::from_str_radix(text.strip_prefix("0x")?, 16).ok()
}

impl Ranges {
    /// The ranges of a reading of a driver's part that is set up as the protocol says.
    pub(crate) fn of(driver: &str, reading: Option<&str>, protocol: &Protocol) -> Self {
        let [ranges, rates] = [RANGES, RATES].map(|table| Setting::of(table, driver, reading));
        Self { ranges, rates, planned: planned(protocol) }
    }

    /// How many counts the part gives for each one that the design expects; 0 if it does not measure.
    pub(crate) fn factor(&self, written: &BTreeMap<u16, u8>) -> f64 {
        let is_still = |one: &Setting| one.value(&self.planned) > 0.0 && one.value(written) == 0.0;
        if self.rates.iter().any(is_still) {
            return 0.0;
        }
        let each = self.ranges.iter().map(|one| match one.value(&self.planned) {
            0.0 => 1.0,
            planned => one.value(written) / planned,
        });
        each.product()
    }

    /// The time from one measurement to the next; `None` if it is not known, or if the part always measures.
    pub(crate) fn period_ns(&self, written: &BTreeMap<u16, u8>) -> Option<u64> {
        let slowest = self.rates.iter().map(|one| one.value(written)).reduce(f64::min)?;
        (slowest > 0.0).then(|| nanoseconds(1e9 / slowest))
    }

    /// The time from one measurement to the next according to the design; 0 if there is none.
    pub(crate) fn planned_ns(&self) -> u64 {
        self.period_ns(&self.planned).unwrap_or(0)
    }
}

/// The contents of the registers after a part was set up.
fn planned(protocol: &Protocol) -> BTreeMap<u16, u8> {
    let width = usize::from(protocol.register_bytes.clamp(1, 2));
    let mut registers = BTreeMap::new();
    for step in &protocol.init {
        let InitStep::Write(bytes) = step else { continue };
        let (first, values) = bytes.split_at(width.min(bytes.len()));
        let first = first.iter().fold(0, |sum, byte| sum << 8 | u16::from(*byte));
        registers.extend((first..=u16::MAX).zip(values.iter().copied()));
    }
    registers
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_line_can_be_read_and_has_its_reset_among_its_codes_or_measures_nothing() {
        for table in [RANGES, RATES] {
            for line in table.lines().skip(1) {
                let mut cells = line.split(',');
                let (driver, reading) = (cells.next().unwrap(), cells.next().unwrap());
                let all = Setting::of(table, driver, Some(reading));
                assert!(!all.is_empty(), "{line}");
                for one in all {
                    assert!(one.codes.iter().all(|(code, _)| code & !one.mask == 0), "{line}");
                    assert!(one.codes.iter().all(|(_, value)| *value > 0.0), "{line}");
                }
            }
        }
    }

    #[test]
    fn another_range_gives_other_counts() {
        let init = vec![InitStep::Write(vec![0x1B, 0x00]), InitStep::Write(vec![0x1C, 0x08])];
        let protocol = Protocol { init, register_bytes: 1, ..Protocol::default() };
        let ranges = Ranges::of("mpu6050", Some("acceleration"), &protocol);
        let factor = |code: u8| ranges.factor(&BTreeMap::from([(0x1C, code)]));
        assert_eq!([factor(0x08), factor(0x10), factor(0x00)], [1.0, 0.5, 2.0]);
        // A register that was never written has its power-up value.
        assert_eq!(ranges.factor(&BTreeMap::new()), 2.0);
        let none = Ranges::of("mpu6050", Some("temperature"), &protocol);
        assert_eq!(none.factor(&BTreeMap::from([(0x1C, 0x18)])), 1.0);
    }

    #[test]
    fn another_rate_measures_at_other_times() {
        let init = vec![InitStep::Write(vec![0x2C, 0x0A])];
        let protocol = Protocol { init, register_bytes: 1, ..Protocol::default() };
        let rates = Ranges::of("adxl345", Some("acceleration"), &protocol);
        assert_eq!(rates.planned_ns(), 10_000_000);
        assert_eq!(rates.period_ns(&BTreeMap::from([(0x2C, 0x07)])), Some(80_000_000));
        assert_eq!(Ranges::default().planned_ns(), 0);
    }
}
