//! A place where a frame may start, and how far its bytes have been checked.

use super::leap::{Ids, Leap, Leaps};
use super::memo::Memo;
use super::table::Table;
use crate::health::HEALTH_REQUEST;
use crate::schema::{
    Checksum, Direction, HEALTH_REQUEST_BYTES, HELLO_BYTES, HELLO_REQUEST_BYTES, ID_CHECKSUM,
    ID_HEALTH, ID_HELLO, STAMP_BYTES, Schema,
};

/// What the available bytes can be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Verdict {
    /// No valid frame starts here.
    Invalid,
    /// A valid frame may start here; more bytes are needed.
    Incomplete,
    /// A valid frame.
    Complete,
}

/// The facts that all frames of a link share in one direction.
#[derive(Clone, Debug)]
pub(super) struct Rules {
    pub(super) table: Table,
    pub(super) checksum: Checksum,
    /// Most bytes of any payload, including its checksum.
    payload_bytes_max: usize,
    /// Most bytes of any payload except health; like the following fields, without the checksum.
    short_bytes_max: usize,
    hello_bytes: usize,
    /// Bytes of a payload that begins with 255; 0 if there is none.
    health_bytes: usize,
    /// Bytes of a request for health; 0 if there is none.
    health_request_bytes: usize,
    is_stamped: bool,
}

impl Rules {
    pub(super) fn new(table: Table, schema: &Schema, direction: Direction) -> Self {
        let (hello_bytes, health_bytes, health_request_bytes) = match direction {
            Direction::Sensor => (HELLO_BYTES, schema.health_bytes(), 0),
            Direction::Actuator => (HELLO_REQUEST_BYTES, 0, HEALTH_REQUEST_BYTES),
        };
        Self {
            table,
            checksum: schema.checksum,
            payload_bytes_max: schema.payload_bytes_max(direction),
            short_bytes_max: schema.short_bytes_max(direction),
            hello_bytes,
            health_bytes,
            health_request_bytes,
            is_stamped: schema.stamp && direction == Direction::Sensor,
        }
    }
}

/// Knowledge left by earlier candidates that failed.
pub(super) struct Past<'m> {
    /// The place of the candidate's first byte in the stream.
    pub(super) place: u64,
    /// Present if an earlier candidate has checked the same bytes.
    pub(super) memo: Option<&'m mut Memo>,
    /// Present if an earlier candidate has passed the same identifiers.
    pub(super) leaps: Option<&'m mut Leaps>,
}

/// A candidate for a frame. All places are counted from its first byte.
#[derive(Clone, Debug, Default)]
pub(super) struct Candidate {
    /// Where the payload starts; 0 until the length has been read.
    pub(super) payload_start: usize,
    /// The place of the checksum or, if there is none, of the comma.
    pub(super) values_end: usize,
    pub(super) frame_bytes: usize,
    /// The place of the next identifier; 0 until the length has been read.
    pub(super) at: usize,
    /// Values and checksum have been checked byte by byte up to this place.
    pub(super) looked_at: usize,
    is_checksum_right: bool,
    /// A bit for each identifier found in this payload.
    seen: Ids,
}

impl Candidate {
    /// Moves to another place, about which nothing is known; the other fields are set when its
    /// length has been read.
    #[inline]
    pub(super) fn restart(&mut self) {
        self.payload_start = 0;
        self.frame_bytes = 0;
        self.at = 0;
        self.looked_at = 0;
        self.is_checksum_right = false;
    }

    /// Checks the bytes from the candidate's first one on, and no byte twice.
    #[inline]
    pub(super) fn look(&mut self, rules: &Rules, bytes: &[u8], past: &mut Past<'_>) -> Verdict {
        if self.payload_start == 0 {
            match self.read_length(rules, bytes) {
                Verdict::Complete => {}
                verdict @ (Verdict::Invalid | Verdict::Incomplete) => return verdict,
            }
        }
        // The cheapest check first: most bytes that only look like a frame do not end with a comma.
        let comma = bytes.get(self.frame_bytes - 1).copied();
        if comma.is_some_and(|byte| byte != b',') {
            return Verdict::Invalid;
        }
        let has_checksum = rules.checksum.is_some();
        if has_checksum && bytes.get(self.values_end).is_some_and(|&id| id != ID_CHECKSUM) {
            return Verdict::Invalid;
        }
        // With the sums, the checksum costs less than a walk.
        if has_checksum && comma.is_some() && past.memo.is_some() && !self.is_checksum_right {
            match self.compare_checksum(rules.checksum, bytes, past) {
                Verdict::Complete => {}
                verdict @ (Verdict::Invalid | Verdict::Incomplete) => return verdict,
            }
        }
        match self.walk(rules, bytes, past) {
            Verdict::Complete => {}
            verdict @ (Verdict::Invalid | Verdict::Incomplete) => return verdict,
        }
        if has_checksum && !self.is_checksum_right {
            match self.compare_checksum(rules.checksum, bytes, past) {
                Verdict::Complete => {}
                verdict @ (Verdict::Invalid | Verdict::Incomplete) => return verdict,
            }
        }
        if comma.is_some() { Verdict::Complete } else { Verdict::Incomplete }
    }

    #[inline]
    fn read_length(&mut self, rules: &Rules, bytes: &[u8]) -> Verdict {
        let mut payload_bytes = 0_usize;
        for (index, &byte) in bytes.iter().enumerate() {
            match byte {
                b'0' if index == 0 => return Verdict::Invalid,
                b'0'..=b'9' => payload_bytes = payload_bytes * 10 + usize::from(byte - b'0'),
                b':' if index > 0 && payload_bytes > rules.checksum.size_bytes() => {
                    self.payload_start = index + 1;
                    self.at = self.payload_start;
                    self.frame_bytes = self.payload_start + payload_bytes + 1;
                    self.values_end = self.frame_bytes - 1 - rules.checksum.size_bytes();
                    self.seen = [0; 4];
                    let values_bytes = self.values_end - self.payload_start;
                    let is_possible =
                        values_bytes <= rules.short_bytes_max || values_bytes == rules.health_bytes;
                    return if is_possible { Verdict::Complete } else { Verdict::Invalid };
                }
                _ => return Verdict::Invalid,
            }
            if payload_bytes > rules.payload_bytes_max {
                return Verdict::Invalid;
            }
        }
        Verdict::Incomplete
    }

    /// Walks from identifier to identifier, up to the end of the values.
    #[inline]
    fn walk(&mut self, rules: &Rules, bytes: &[u8], past: &mut Past<'_>) -> Verdict {
        if self.at == self.payload_start {
            match self.begin(rules, bytes) {
                Verdict::Complete => {}
                verdict @ (Verdict::Invalid | Verdict::Incomplete) => return verdict,
            }
        }
        if let Some(leaps) = past.leaps.take() {
            return self.leap(rules, bytes, past, leaps);
        }
        while self.at < self.values_end {
            match self.step(rules, bytes, past) {
                Verdict::Complete => {}
                verdict @ (Verdict::Invalid | Verdict::Incomplete) => return verdict,
            }
        }
        Verdict::Complete
    }

    /// Determines the sort of payload from its first byte, its length and the schema. Skips a
    /// stamp, and all of a payload that is not a report.
    #[inline]
    fn begin(&mut self, rules: &Rules, bytes: &[u8]) -> Verdict {
        let Some(&id) = bytes.get(self.at) else { return Verdict::Incomplete };
        let values_bytes = self.values_end - self.payload_start;
        match id {
            ID_HELLO if values_bytes == rules.hello_bytes => self.at = self.values_end,
            ID_HELLO if values_bytes == rules.health_request_bytes => {
                match bytes.get(self.at + 1) {
                    None => return Verdict::Incomplete,
                    Some(&HEALTH_REQUEST) => self.at = self.values_end,
                    Some(_) => return Verdict::Invalid,
                }
            }
            ID_HELLO
                if rules.is_stamped
                    && (STAMP_BYTES + 1..=rules.short_bytes_max).contains(&values_bytes) =>
            {
                self.at += STAMP_BYTES;
            }
            ID_HEALTH if values_bytes == rules.health_bytes => self.at = self.values_end,
            ID_HELLO | ID_HEALTH => return Verdict::Invalid,
            _ if rules.is_stamped || values_bytes > rules.short_bytes_max => {
                return Verdict::Invalid;
            }
            _ => {}
        }
        Verdict::Complete
    }

    /// Like [`Self::walk`], but uses leaps left by other candidates, and leaves leaps for others.
    fn leap(
        &mut self,
        rules: &Rules,
        bytes: &[u8],
        past: &mut Past<'_>,
        leaps: &mut Leaps,
    ) -> Verdict {
        let mut steps = Leap::new(past.place + self.at as u64);
        let mut is_behind_leap = false;
        while self.at < self.values_end {
            let from = self.at;
            let mut leap = leaps.at(past.place + from as u64);
            if let Some(longer) = leap.take_if(|leap| from + leap.bytes() > self.values_end)
                && longer.misses(self.values_end - from)
            {
                return Verdict::Invalid;
            }
            if let Some(leap) = leap {
                self.at += leap.bytes();
                if !leap.see(&mut self.seen) {
                    return Verdict::Invalid;
                }
                // Otherwise every candidate would take these few steps between two leaps.
                if is_behind_leap && steps.bytes() > 0 {
                    leaps.put(steps);
                }
            } else {
                match self.step(rules, bytes, past) {
                    Verdict::Complete => {}
                    verdict @ (Verdict::Invalid | Verdict::Incomplete) => return verdict,
                }
                let id = bytes.get(from).copied().unwrap_or_default();
                if !steps.add(id, self.at - from) {
                    continue;
                }
                leaps.put(steps);
            }
            steps = Leap::new(past.place + self.at as u64);
            is_behind_leap = true;
        }
        Verdict::Complete
    }

    /// Steps to the next identifier.
    #[inline]
    fn step(&mut self, rules: &Rules, bytes: &[u8], past: &mut Past<'_>) -> Verdict {
        let Some(&id) = bytes.get(self.at) else { return Verdict::Incomplete };
        let slot = rules.table.slot(id);
        let end = self.at + 1 + slot.value_bytes();
        let bit = 1_u64 << (id % 64);
        let seen = self.seen.get(usize::from(id / 64)).copied().unwrap_or_default();
        if slot.value_bytes() == 0 || seen & bit != 0 || end > self.values_end {
            return Verdict::Invalid;
        }
        if slot.is_bool() {
            match self.look_at_bools(bytes, end, past) {
                Verdict::Complete => {}
                verdict @ (Verdict::Invalid | Verdict::Incomplete) => return verdict,
            }
        }
        if let Some(word) = self.seen.get_mut(usize::from(id / 64)) {
            *word |= bit;
        }
        self.at = end;
        Verdict::Complete
    }

    /// Checks the elements of the value before `end`, as many as are available.
    fn look_at_bools(&mut self, bytes: &[u8], end: usize, past: &mut Past<'_>) -> Verdict {
        let from = self.looked_at.max(self.at + 1);
        let to = end.min(bytes.len());
        if from < to {
            let are_bools = match &mut past.memo {
                Some(memo) => memo.all_bools(past.place, bytes, from, to),
                None => bytes.get(from..to).unwrap_or_default().iter().all(|&byte| byte <= 1),
            };
            self.looked_at = to;
            if !are_bools {
                return Verdict::Invalid;
            }
        }
        if to == end { Verdict::Complete } else { Verdict::Incomplete }
    }

    fn compare_checksum(
        &mut self,
        checksum: Checksum,
        bytes: &[u8],
        past: &mut Past<'_>,
    ) -> Verdict {
        let sent = bytes.get(self.values_end + 1..).and_then(|rest| checksum.read(rest));
        let Some(sent) = sent else { return Verdict::Incomplete };
        let crc = match &mut past.memo {
            Some(memo) => memo.crc(past.place, bytes, self.payload_start, self.values_end),
            None => checksum.of(bytes.get(self.payload_start..self.values_end).unwrap_or_default()),
        };
        self.is_checksum_right = sent == crc;
        // Values that have not been walked through may still contain an invalid bool.
        if !self.is_checksum_right || self.at == self.values_end {
            self.looked_at = self.values_end;
        }
        if self.is_checksum_right { Verdict::Complete } else { Verdict::Invalid }
    }
}
