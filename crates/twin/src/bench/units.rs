//! The numbers of a board's peripheral instances.
//!
//! Emulated MCUs know their units by number; the only unit of a kind may have none in its name (`CAN`) and is the
//! first. Low-power serial ports have numbers behind all others. Boards that cannot be emulated may have two of a kind
//! that end in the same number. The second one gets a number that no other unit has.

use std::collections::BTreeMap;

use sensedsl_job::BoardJob;
use sensedsl_model::kind::KindName;

/// The number before that of the first low-power serial port: `LPUART1` is not `USART1`.
const LOW_POWER: u8 = 127;
/// The first number for units whose own is taken.
const OTHERS_FROM: u8 = 144;

/// The numbers of all units that devices are wired to.
#[derive(Clone, Debug, Default)]
pub(crate) struct Units(BTreeMap<String, u8>);

impl Units {
    pub(crate) fn new(job: &BoardJob<'_>) -> Self {
        let mut taken: BTreeMap<(KindName, u8), &str> = BTreeMap::new();
        let mut units: BTreeMap<String, u8> = BTreeMap::new();
        let mut other = OTHERS_FROM;
        for one in &job.connections {
            let Some(name) = one.unit.filter(|name| !units.contains_key(*name)) else { continue };
            let kind = one.connection.kind.name();
            let is_only = !name.contains(|c: char| c.is_ascii_digit());
            let own = if is_only { Some(1) } else { number_of(name) };
            let own = own.filter(|number| *number < OTHERS_FROM);
            let own = own.filter(|number| *taken.entry((kind, *number)).or_insert(name) == name);
            let number = own.unwrap_or_else(|| {
                other = other.saturating_add(1);
                other - 1
            });
            units.insert(name.to_owned(), number);
        }
        Self(units)
    }

    /// The number of a unit.
    pub(crate) fn number(&self, name: &str) -> Option<u8> {
        self.0.get(name).copied()
    }
}

/// The number of a peripheral instance: 2 of `USART2`, 128 of `LPUART1`.
#[must_use]
pub fn number_of(unit: &str) -> Option<u8> {
    let digits = unit.trim_start_matches(|c: char| !c.is_ascii_digit());
    // `I2C3`: the number is after the last letter.
    let last = digits.rsplit(|c: char| !c.is_ascii_digit()).next()?;
    let number: u8 = last.parse().ok()?;
    if unit.starts_with("LP") { number.checked_add(LOW_POWER) } else { Some(number) }
}
