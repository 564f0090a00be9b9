//! Several steps from identifier to identifier taken as one.
//!
//! Candidates for a frame overlap, and from where two of them come upon the same identifier they go
//! the same way: which bytes are identifiers, whether they are known and whether values are bools
//! depends on nothing but the place. Only what a candidate has seen before differs, so a leap keeps
//! the identifiers that it passes over. A candidate then goes from leap to leap and steps only
//! before the first and behind the last. It needs memory for one frame, and only after a candidate
//! has failed and the next one went through many identifiers.

use alloc::vec::Vec;

/// Steps of a leap. A candidate makes fewer than so many before it meets a leap, and fewer behind
/// the last one; in between it leaps, in 254 steps as often as this is contained in them.
const STEPS: u32 = 16;

/// A bit for each identifier.
pub(super) type Ids = [u64; 4];

#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Leap {
    /// Of the identifier it starts at.
    place: u64,
    bytes: u32,
    steps: u32,
    ids: Ids,
    /// Bit k: an identifier of it stands k bytes behind its place.
    stands: u64,
}

impl Leap {
    /// One that ends where it starts.
    pub(super) fn new(place: u64) -> Self {
        Self { place, ..Self::default() }
    }

    #[inline]
    pub(super) fn bytes(&self) -> usize {
        self.bytes as usize
    }

    /// One step more. True when that is as far as a leap goes.
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

    /// Whether it is known that an item reaches past `bytes` bytes, fewer than it has.
    #[inline]
    pub(super) fn misses(&self, bytes: usize) -> bool {
        bytes < 64 && self.stands >> bytes & 1 == 0
    }

    /// Adds its identifiers to `seen`. False when one of them is there already.
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

/// Leaps by the place in the stream they start at.
#[derive(Clone, Debug)]
pub(super) struct Leaps {
    frame_bytes_max: usize,
    /// By place, a ring longer than a frame: where in the next list its leap is, if it is.
    index: Vec<u16>,
    /// The latest ones, a ring as well: side by side, as candidates go through them.
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
        // Where the end of a candidate has cut this one short there is a longer one.
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
