//! Sets of pins.

use crate::problem::PinId;

/// A set of pins, a bit each.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct PinSet(Vec<u64>);

impl PinSet {
    pub(super) fn add(&mut self, pin: PinId) {
        let (word, bit) = (pin.0 as usize / 64, pin.0 % 64);
        if self.0.len() <= word {
            self.0.resize(word + 1, 0);
        }
        if let Some(word) = self.0.get_mut(word) {
            *word |= 1 << bit;
        }
    }

    pub(super) fn add_all(&mut self, other: &Self) {
        if self.0.len() < other.0.len() {
            self.0.resize(other.0.len(), 0);
        }
        for (own, other) in self.0.iter_mut().zip(&other.0) {
            *own |= other;
        }
    }

    pub(super) fn has(&self, pin: PinId) -> bool {
        self.0.get(pin.0 as usize / 64).is_some_and(|word| word >> (pin.0 % 64) & 1 == 1)
    }

    pub(super) fn meets(&self, other: &Self) -> bool {
        self.0.iter().zip(&other.0).any(|(one, other)| one & other != 0)
    }

    /// The pins in both sets, ascending.
    pub(super) fn common(&self, other: &Self) -> impl Iterator<Item = PinId> {
        let words = self.0.iter().zip(&other.0).enumerate();
        words.flat_map(|(at, (one, other))| {
            let both = one & other;
            let bits = (0..64u32).filter(move |bit| both >> bit & 1 == 1);
            bits.map(move |bit| PinId(at as u32 * 64 + bit))
        })
    }
}

impl FromIterator<PinId> for PinSet {
    fn from_iter<I: IntoIterator<Item = PinId>>(pins: I) -> Self {
        let mut set = Self::default();
        pins.into_iter().for_each(|pin| set.add(pin));
        set
    }
}
