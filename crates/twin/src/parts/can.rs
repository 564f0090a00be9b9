//! Other stations of a CAN bus, which send frames by themselves.

use sensedsl_model::words::Words;

use super::words::bytes;
use crate::surroundings::CanFrame;
use crate::truth::Subject;

/// The longest time between two frames.
const PERIOD_NS_MAX: u64 = 50_000_000;
/// And the shortest.
const PERIOD_NS_MIN: u64 = 2_000_000;
/// The greatest identifier of eleven bits.
const STANDARD_MAX: u32 = 0x7FF;

/// A value in a frame.
#[derive(Clone, Debug)]
pub(crate) struct Field {
    /// Index of the subject.
    pub(crate) subject: usize,
    /// Where it begins.
    pub(crate) byte: u8,
    /// How it is coded.
    pub(crate) words: Words,
}

/// A frame that somebody sends again and again.
#[derive(Clone, Debug)]
pub(crate) struct Sender {
    pub(crate) id: u32,
    pub(crate) fields: Vec<Field>,
    pub(crate) period_ns: u64,
    next_ns: u64,
}

impl Sender {
    pub(crate) const fn new(id: u32) -> Self {
        Self { id, fields: Vec::new(), period_ns: PERIOD_NS_MAX, next_ns: 0 }
    }

    /// A further value, for a device of that cycle.
    pub(crate) fn add(&mut self, field: Field, delay_ns: u64) {
        self.fields.push(field);
        self.period_ns = self.period_ns.min((delay_ns / 2).max(PERIOD_NS_MIN));
    }

    /// The frame, when it is due. What was due in the meantime is lost where `is_cut`.
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
        let (mut data, mut length) = ([0_u8; 8], 0);
        for field in &self.fields {
            let Some(subject) = subjects.get(field.subject) else { continue };
            let elements = 0..subject.signals.len();
            let raw: Vec<f64> = elements.map(|one| subject.raw(one, now_ns)).collect();
            let first = usize::from(field.byte);
            for (place, byte) in (first..).zip(bytes(&field.words, &raw)) {
                if let Some(target) = data.get_mut(place) {
                    *target |= byte;
                    length = length.max(place + 1);
                }
            }
        }
        let extended = self.id > STANDARD_MAX;
        let length = u8::try_from(length).unwrap_or(8);
        Some(CanFrame { id: self.id, extended, remote: false, length, data })
    }
}
