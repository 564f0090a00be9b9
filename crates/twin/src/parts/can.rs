//! The other stations on a CAN bus, which send frames by themselves.

use sensedsl_model::words::Words;

use super::words::bytes;
use crate::truth::Subject;
use sensedsl_surroundings::CanFrame;

/// The longest time between two frames.
const PERIOD_NS_MAX: u64 = 50_000_000;
/// The shortest time between two frames.
const PERIOD_NS_MIN: u64 = 2_000_000;

/// A value in a frame.
#[derive(Clone, Debug)]
pub(crate) struct Field {
    /// The index of the subject.
    pub(crate) subject: usize,
    /// The byte at which it starts.
    pub(crate) byte: u8,
    /// The coding of the value.
    pub(crate) words: Words,
    /// The frame has this value only if these bits of it (the mask) are so (the value); byte 0 is the lowest.
    pub(crate) select: Option<(u64, u64)>,
    /// The length of the frame in bytes, if it is known.
    pub(crate) length: Option<u8>,
}

/// A frame that a station sends again and again.
#[derive(Clone, Debug)]
pub(crate) struct Sender {
    pub(crate) id: u32,
    pub(crate) is_extended: bool,
    pub(crate) fields: Vec<Field>,
    pub(crate) period_ns: u64,
    next_ns: u64,
    /// The selections for multiplexed fields, each once, and the index of the next one: a frame has one of them.
    selections: Vec<(u64, u64)>,
    turn: usize,
}

impl Sender {
    pub(crate) fn new(id: u32, is_extended: bool) -> Self {
        let (fields, selections) = (Vec::new(), Vec::new());
        let (period_ns, next_ns) = (PERIOD_NS_MAX, 0);
        Self { id, is_extended, fields, period_ns, next_ns, selections, turn: 0 }
    }

    /// The time from one frame with all of its values to the next.
    pub(crate) fn round_ns(&self) -> u64 {
        self.period_ns * self.selections.len().max(1) as u64
    }

    /// Adds a value, for a device with that cycle.
    pub(crate) fn add(&mut self, field: Field, delay_ns: u64) {
        if let Some(select) = field.select
            && !self.selections.contains(&select)
        {
            self.selections.push(select);
        }
        self.fields.push(field);
        // Each selection comes as often as a frame without selections would.
        let turns = self.selections.len().max(1) as u64;
        self.period_ns = self.period_ns.min((delay_ns / 2 / turns).max(PERIOD_NS_MIN));
    }

    /// The frame, if it is due. If `is_cut`, all frames that were due in the meantime are lost.
    pub(crate) fn next(
        &mut self,
        subjects: &[Subject],
        now_ns: u64,
        is_cut: bool,
    ) -> Option<CanFrame> {
        if now_ns < self.next_ns {
            return None;
        }
        self.next_ns = (now_ns / self.period_ns + 1) * self.period_ns;
        if is_cut {
            return None;
        }
        let select = self.selections.get(self.turn % self.selections.len().max(1)).copied();
        self.turn = self.turn.wrapping_add(1);
        let (mut bits, mut length) = (0_u64, 0);
        let is_in = |field: &&Field| field.select.is_none() || field.select == select;
        for field in self.fields.iter().filter(is_in) {
            let Some(subject) = subjects.get(field.subject) else { continue };
            let elements = 0..subject.signals.len();
            let raw: Vec<f64> = elements.map(|one| subject.raw(one, now_ns)).collect();
            let first = usize::from(field.byte);
            let mut data = [0_u8; 8];
            for (place, byte) in (first..).zip(bytes(&field.words, &raw)) {
                if let Some(target) = data.get_mut(place) {
                    *target = byte;
                    length = length.max(place + 1);
                }
            }
            let mask = field.words.in_frame(field.byte);
            bits = bits & !mask | u64::from_le_bytes(data) & mask;
            length = length.max(field.length.unwrap_or(0).into());
        }
        // The selecting value is the one of this frame, whatever the world says about it.
        if let Some((mask, selected)) = select {
            bits = bits & !mask | selected;
        }
        let length = u8::try_from(length).unwrap_or(8).min(8);
        let (id, extended) = (self.id, self.is_extended);
        Some(CanFrame { id, extended, remote: false, length, data: bits.to_le_bytes() })
    }
}
