//! Several steps from identifier to identifier, taken as one.
//!
//! Candidates for a frame overlap. When two of them reach the same identifier, they continue the
//! same way, because only the place determines which bytes are identifiers, whether they are known
//! and whether values are bools. Candidates differ only in the identifiers that they have already
//! seen, so a leap records the identifiers that it passes. A candidate then goes from leap to leap,
//! and steps only before the first and after the last one. Leaps need memory for one frame, and
//! only after a candidate has failed and the next one has passed many identifiers.

use alloc::vec::Vec;

/// Steps of a leap. A candidate takes fewer than this many steps before it meets a leap, and fewer
/// after the last one; in between it leaps, at most 254 / `STEPS` times.
const STEPS: u32 = 16;

/// A bit for each identifier.
pub(super) type Ids = [u64; 4];

#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Leap {
    /// The place of the identifier that it starts at.
    place: u64,
    bytes: u32,
    steps: u32,
    ids: Ids,
    /// Bit k: one of its identifiers is k bytes after its place.
    stands: u64,
}

impl Leap {
    /// A leap that ends where it starts.
    pub(super) fn new(place: u64) -> Self {
        Self { place, ..Self::default() }
    }

    #[inline]
    pub(super) fn bytes(&self) -> usize {
        self.bytes as usize
    }

    /// Adds a step. Returns true if the leap has reached its full length.
    #[inline]
    pub(super) fn add(&mut self, id: u8, bytes: usize) -> bool {
        if let Some(word) = self.ids.get_mut(usize::from(id / 64)) {
            *word |= 1 << (id % 64);
        }
        self.stands |= 1_u64.checked_shl(self.bytes).unwrap_or_default();
        self.bytes += bytes as u32;
        self.steps += 1;
        self.steps == STEPS
    }

    /// Whether an item is known to extend past `bytes` bytes, which are fewer than the leap has.
    #[inline]
    pub(super) fn misses(&self, bytes: usize) -> bool {
        bytes < 64 && self.stands >> bytes & 1 == 0
    }

    /// Adds its identifiers to `seen`. Returns false if one of them is already there.
    #[inline]
    pub(super) fn see(&self, seen: &mut Ids) -> bool {
        let mut twice = 0;
        for (seen, ids) in seen.iter_mut().zip(&self.ids) {
            twice |= *seen & ids;
            *seen |= ids;
        }
        twice == 0
    }
}

/// Leaps, by the place in the stream where they start.
#[derive(Clone, Debug)]
pub(super) struct Leaps {
    frame_bytes_max: usize,
    /// By place, in a ring longer than a frame: the index of the leap in `leaps`, if there is one.
    index: Vec<u16>,
    /// The latest leaps, also in a ring: next to each other, in the order in which candidates use
    /// them.
    leaps: Vec<Leap>,
    put: usize,
}

impl Leaps {
    pub(super) fn new(frame_bytes_max: usize) -> Self {
        Self { frame_bytes_max, index: Vec::new(), leaps: Vec::new(), put: 0 }
    }

    #[inline]
    pub(super) fn at(&self, place: u64) -> Option<&Leap> {
        let slot = place as usize & self.index.len().wrapping_sub(1);
        let leap = self.leaps.get(usize::from(*self.index.get(slot)?))?;
        (leap.place == place && leap.steps > 0).then_some(leap)
    }

    pub(super) fn put(&mut self, leap: Leap) {
        if self.index.is_empty() {
            let size = (self.frame_bytes_max + 1).next_power_of_two();
            self.index = alloc::vec![0; size];
            self.leaps = alloc::vec![Leap::default(); size / 8];
        }
        // If the end of a candidate has cut this leap short, there is a longer one.
        if self.at(leap.place).is_some() {
            return;
        }
        let slot = leap.place as usize & self.index.len().wrapping_sub(1);
        self.put = (self.put + 1) & (self.leaps.len() - 1);
        if let (Some(index), Some(slot)) = (self.index.get_mut(slot), self.leaps.get_mut(self.put))
        {
            *index = self.put as u16;
            *slot = leap;
        }
    }
}
