//! What is known of every window of the stream that has been checked: its checksum, and whether all
//! its bytes are bools.
//!
//! Candidates for a frame overlap where one is in the payload of another, and each would check the
//! same bytes again. With sums over everything since one place, a window costs the same whatever
//! its length. The sums need memory for one frame, and only after a candidate has failed.

use alloc::vec::Vec;

use crate::schema::Checksum;

#[derive(Clone, Copy, Debug, Default)]
struct Sums {
    /// The CRC's register over the bytes before this place, from an initial value of 0.
    crc: u32,
    /// The number of consecutive bytes before this place that are 0 or 1.
    bools: u32,
}

/// Sums, by place in the stream.
#[derive(Clone, Debug)]
pub(super) struct Memo {
    checksum: Checksum,
    frame_bytes_max: usize,
    /// A ring longer than a frame, so that nothing moves as the stream continues.
    sums: Vec<Sums>,
    /// By number of bytes: the factor by which that many zero bytes multiply a register.
    powers: Vec<u32>,
    /// The place after the last byte that is in the sums.
    frontier: u64,
}

impl Memo {
    pub(super) fn new(checksum: Checksum, frame_bytes_max: usize) -> Self {
        Self { checksum, frame_bytes_max, sums: Vec::new(), powers: Vec::new(), frontier: 0 }
    }

    /// The CRC of `frame[from..to]`, where `frame` starts at `place`. If the places of successive
    /// calls never go back, each byte is read only once.
    pub(super) fn crc(&mut self, place: u64, frame: &[u8], from: usize, to: usize) -> u32 {
        self.extend(place, frame, to);
        // A CRC is linear: its initial value and the bytes before the window shift through it.
        let (start, end) = self.checksum.ends();
        let before = self.at(place, from).crc ^ start;
        let power = self.powers.get(to - from).copied().unwrap_or_default();
        self.at(place, to).crc ^ self.checksum.product(before, power) ^ end
    }

    /// Whether all of `frame[from..to]` is 0 or 1.
    pub(super) fn all_bools(&mut self, place: u64, frame: &[u8], from: usize, to: usize) -> bool {
        self.extend(place, frame, to);
        self.at(place, to).bools as usize >= to - from
    }

    fn at(&self, place: u64, index: usize) -> Sums {
        let ring = place.wrapping_add(index as u64) as usize & (self.sums.len().wrapping_sub(1));
        self.sums.get(ring).copied().unwrap_or_default()
    }

    fn put(&mut self, place: u64, sums: Sums) {
        let ring = place as usize & (self.sums.len().wrapping_sub(1));
        if let Some(slot) = self.sums.get_mut(ring) {
            *slot = sums;
        }
    }

    fn extend(&mut self, place: u64, frame: &[u8], to: usize) {
        if self.sums.is_empty() {
            self.sums =
                alloc::vec![Sums::default(); (self.frame_bytes_max + 1).next_power_of_two()];
            let powers = (0..=self.frame_bytes_max).scan(self.checksum.one(), |power, _| {
                let this = *power;
                *power = self.checksum.step(this, 0);
                Some(this)
            });
            self.powers = powers.collect();
        }
        if self.frontier < place {
            self.frontier = place;
            self.put(place, Sums::default());
        }
        let known = (self.frontier - place) as usize;
        let mut sums = self.at(place, known);
        for &byte in frame.get(known..to).unwrap_or_default() {
            sums.crc = self.checksum.step(sums.crc, byte);
            sums.bools = if byte <= 1 { sums.bools.saturating_add(1) } else { 0 };
            self.frontier += 1;
            self.put(self.frontier, sums);
        }
    }
}
