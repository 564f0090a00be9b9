//! From a byte stream to the content of its frames, however it is split and whatever garbage is
//! between frames.
//!
//! A candidate that cannot become a valid frame loses only its first byte, and the rest is scanned
//! again, so the first valid frame is found wherever it starts. A frame that is complete within the
//! bytes of one call is read in place; only what a call leaves unfinished is copied.
//!
//! Nothing is kept of failed candidates, so in the worst case the longest frame is scanned again
//! for each digit in the stream. Frames to a board are short; the decoders of hosts, which read
//! long ones, keep what they have found out.

use core::ops::{Deref, DerefMut};

use crate::bits::Bits;
use crate::bytes::{at, copy, move_down, part, part_mut, word};
use crate::encode::Stamp;
use crate::scalar::Scalar;
use crate::schema::{
    Direction, HEALTH_REQUEST, HEALTH_REQUEST_BYTES, HELLO_BYTES, ID_CHECKSUM, ID_HEALTH, ID_HELLO,
    STAMP_BYTES, Schema,
};

/// The content of a frame that is valid to its last byte.
#[derive(Clone, Copy, Debug)]
pub enum Frame<'a> {
    /// Values, with the stamp if the link has one.
    Values(Option<Stamp>, Items<'a>),
    /// The hash of the board's schema (board to host).
    Hello(u32),
    /// The payload of health, unparsed (board to host).
    Health(&'a [u8]),
    /// The host wants a hello (host to board).
    HelloRequest,
    /// The host wants health (host to board).
    HealthRequest,
}

/// The values of a frame: the index of each item in the schema, and its bytes.
#[derive(Clone, Copy, Debug)]
pub struct Items<'a> {
    schema: &'static Schema,
    direction: Direction,
    bytes: &'a [u8],
}

impl<'a> Iterator for Items<'a> {
    type Item = (usize, &'a [u8]);

    fn next(&mut self) -> Option<Self::Item> {
        let (id, rest) = self.bytes.split_first()?;
        let (index, item) = self.schema.find(self.direction, *id)?;
        let (value, rest) = rest.split_at_checked(item.bytes())?;
        self.bytes = rest;
        Some((index, value))
    }
}

/// What the bytes of a candidate can become.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Verdict {
    Invalid,
    Incomplete,
    Complete,
}

/// The rules for frames of one direction.
#[derive(Clone, Copy, Debug)]
struct Rules {
    schema: &'static Schema,
    direction: Direction,
    short_bytes_max: usize,
    payload_bytes_max: usize,
    health_bytes: usize,
}

impl Rules {
    const fn new(schema: &'static Schema, direction: Direction) -> Self {
        Self {
            schema,
            direction,
            short_bytes_max: schema.short_bytes_max(direction),
            payload_bytes_max: schema.payload_bytes_max(direction),
            health_bytes: match direction {
                Direction::ToHost => schema.health_bytes(),
                Direction::ToBoard => 0,
            },
        }
    }

    fn stamps(&self) -> bool {
        self.schema.stamps(self.direction)
    }

    fn checksum_bytes(&self) -> usize {
        self.schema.checksum_bytes()
    }
}

/// A candidate for a frame; all offsets count from its first byte.
#[derive(Clone, Copy, Debug)]
struct Candidate {
    /// 0 until its length has been read.
    payload_start: usize,
    items_start: usize,
    values_end: usize,
    frame_bytes: usize,
    /// The offset of the next identifier.
    at: usize,
    /// How far the elements of a bool have been checked.
    looked_at: usize,
    seen: Bits,
}

impl Candidate {
    const NEW: Self = Self {
        payload_start: 0,
        items_start: 0,
        values_end: 0,
        frame_bytes: 0,
        at: 0,
        looked_at: 0,
        seen: Bits::NONE,
    };

    /// Checks the bytes from the candidate's first on; what has been checked before is not checked
    /// again.
    fn look(&mut self, rules: &Rules, bytes: &[u8]) -> Verdict {
        if self.payload_start == 0 {
            let verdict = self.read_length(rules, bytes);
            if verdict != Verdict::Complete {
                return verdict;
            }
        }
        // The cheapest check first: most false candidates end wrong.
        let has_comma = bytes.len() >= self.frame_bytes;
        if has_comma && at(bytes, self.frame_bytes.wrapping_sub(1)) != b',' {
            return Verdict::Invalid;
        }
        let has_checksum = rules.schema.checksum.is_some();
        if has_checksum && bytes.get(self.values_end).is_some_and(|byte| *byte != ID_CHECKSUM) {
            return Verdict::Invalid;
        }
        let verdict = self.walk(rules, bytes);
        if verdict != Verdict::Complete {
            return verdict;
        }
        if has_checksum {
            let end = self.values_end + rules.checksum_bytes();
            let Some(sent) = bytes.get(self.values_end..end) else {
                return Verdict::Incomplete;
            };
            let payload = bytes.get(self.payload_start..self.values_end).unwrap_or_default();
            if !rules.schema.checksum.behind(payload).starts_with(sent) {
                return Verdict::Invalid;
            }
        }
        if has_comma { Verdict::Complete } else { Verdict::Incomplete }
    }

    fn read_length(&mut self, rules: &Rules, bytes: &[u8]) -> Verdict {
        let mut length = 0;
        for (place, byte) in bytes.iter().enumerate() {
            if *byte == b':' && length > rules.checksum_bytes() {
                let values_bytes = length - rules.checksum_bytes();
                let start = place + 1;
                self.payload_start = start;
                self.items_start = start;
                self.at = start;
                self.values_end = start + values_bytes;
                self.frame_bytes = start + length + 1;
                let is_possible =
                    values_bytes <= rules.short_bytes_max || values_bytes == rules.health_bytes;
                return if is_possible { Verdict::Complete } else { Verdict::Invalid };
            }
            if !byte.is_ascii_digit() {
                return Verdict::Invalid;
            }
            length = length * 10 + usize::from(*byte - b'0');
            if length == 0 || length > rules.payload_bytes_max {
                return Verdict::Invalid;
            }
        }
        Verdict::Incomplete
    }

    /// Determines the type of the payload from its first byte and its length; skips a stamp, or a
    /// whole payload that has no items.
    fn begin(&mut self, rules: &Rules, bytes: &[u8]) -> Verdict {
        if self.at != self.payload_start {
            return Verdict::Complete;
        }
        let values_bytes = self.values_end.wrapping_sub(self.payload_start);
        let is_right = match bytes.get(self.at) {
            None => return Verdict::Incomplete,
            Some(&ID_HELLO) => return self.begin_with_0(rules, bytes, values_bytes),
            Some(&ID_HEALTH) => {
                self.at = self.values_end;
                values_bytes == rules.health_bytes
            }
            Some(_) => !rules.stamps() && values_bytes <= rules.short_bytes_max,
        };
        if is_right { Verdict::Complete } else { Verdict::Invalid }
    }

    /// A payload that begins with 0: a hello or a stamp to the host, a request to the board.
    fn begin_with_0(&mut self, rules: &Rules, bytes: &[u8], values_bytes: usize) -> Verdict {
        if rules.direction == Direction::ToHost {
            if values_bytes == HELLO_BYTES {
                self.at = self.values_end;
                return Verdict::Complete;
            }
            let is_long = values_bytes > STAMP_BYTES && values_bytes <= rules.short_bytes_max;
            if !rules.stamps() || !is_long {
                return Verdict::Invalid;
            }
            self.at += STAMP_BYTES;
            self.items_start = self.at;
            return Verdict::Complete;
        }
        if values_bytes > HEALTH_REQUEST_BYTES {
            return Verdict::Invalid;
        }
        if values_bytes == HEALTH_REQUEST_BYTES {
            match bytes.get(self.at + 1) {
                None => return Verdict::Incomplete,
                Some(&HEALTH_REQUEST) => {}
                Some(_) => return Verdict::Invalid,
            }
        }
        self.at = self.values_end;
        Verdict::Complete
    }

    /// Walks from identifier to identifier up to the end of the values.
    fn walk(&mut self, rules: &Rules, bytes: &[u8]) -> Verdict {
        let verdict = self.begin(rules, bytes);
        if verdict != Verdict::Complete {
            return verdict;
        }
        while self.at < self.values_end {
            let Some(id) = bytes.get(self.at) else { return Verdict::Incomplete };
            let Some((_, item)) = rules.schema.find(rules.direction, *id) else {
                return Verdict::Invalid;
            };
            let end = self.at + 1 + item.bytes();
            if self.seen.has(usize::from(*id)) || end > self.values_end {
                return Verdict::Invalid;
            }
            if item.scalar == Scalar::Bool {
                let verdict = self.look_at_bools(bytes, self.at + 1, end);
                if verdict != Verdict::Complete {
                    return verdict;
                }
            }
            self.seen.set(usize::from(*id));
            self.at = end;
        }
        Verdict::Complete
    }

    /// Checks the elements of a bool value `[value, end)`, as many as are there.
    fn look_at_bools(&mut self, bytes: &[u8], value: usize, end: usize) -> Verdict {
        let from = self.looked_at.max(value);
        let to = end.min(bytes.len());
        if let Some(fresh) = bytes.get(from..to) {
            self.looked_at = to;
            if fresh.iter().any(|byte| *byte > 1) {
                return Verdict::Invalid;
            }
        }
        if to < end { Verdict::Incomplete } else { Verdict::Complete }
    }

    /// The content of the complete frame.
    fn read<'a>(&self, rules: &Rules, frame: &'a [u8]) -> Frame<'a> {
        let payload = frame.get(self.payload_start..self.values_end).unwrap_or_default();
        match payload {
            [ID_HELLO] => Frame::HelloRequest,
            [ID_HELLO, _] => Frame::HealthRequest,
            [ID_HEALTH, ..] => Frame::Health(payload),
            [ID_HELLO, ..] if payload.len() == HELLO_BYTES => Frame::Hello(word(payload, 1)),
            _ => {
                let stamp = Stamp { time_us: word(payload, 1), counter: at(payload, 5) };
                let items = Items {
                    schema: rules.schema,
                    direction: rules.direction,
                    bytes: frame.get(self.items_start..self.values_end).unwrap_or_default(),
                };
                Frame::Values(rules.stamps().then_some(stamp), items)
            }
        }
    }
}

/// A decoder without its buffer.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Machine {
    rules: Rules,
    candidate: Candidate,
    /// The candidate's start and size in the buffer.
    start: usize,
    size: usize,
    frames: u32,
    dropped_bytes: u32,
}

impl Machine {
    /// With too little memory, no frame is accepted.
    pub(crate) const fn new(
        schema: &'static Schema,
        direction: Direction,
        is_enough: bool,
    ) -> Self {
        let mut rules = Rules::new(schema, direction);
        if !is_enough {
            rules.payload_bytes_max = 0;
        }
        Self { rules, candidate: Candidate::NEW, start: 0, size: 0, frames: 0, dropped_bytes: 0 }
    }

    pub(crate) const fn frames(&self) -> u32 {
        self.frames
    }

    pub(crate) const fn is_idle(&self) -> bool {
        self.size == 0
    }

    /// Looks for frames that start before `limit`. Returns the start of the candidate that lacks
    /// bytes, or the place to continue from.
    fn run(&mut self, bytes: &[u8], limit: usize, on_frame: &mut dyn FnMut(Frame<'_>)) -> usize {
        let mut here = 0;
        while here < limit {
            let rest = bytes.get(here..).unwrap_or_default();
            match self.candidate.look(&self.rules, rest) {
                Verdict::Incomplete => return here,
                Verdict::Complete => {
                    on_frame(self.candidate.read(&self.rules, rest));
                    self.frames = self.frames.wrapping_add(1);
                    here += self.candidate.frame_bytes;
                }
                Verdict::Invalid => {
                    let others = bytes.get(here + 1..limit).unwrap_or_default();
                    let skipped = others.iter().position(u8::is_ascii_digit);
                    let gone = 1 + skipped.unwrap_or(others.len());
                    self.dropped_bytes = self.dropped_bytes.wrapping_add(gone as u32);
                    here += gone;
                }
            }
            self.candidate = Candidate::NEW;
        }
        here
    }

    /// Buffers more bytes, at most as many as the candidate lacks; returns how many. While its
    /// length is being read, one at a time.
    fn hold(&mut self, buffer: &mut [u8], bytes: &[u8]) -> usize {
        let missing = match self.candidate.frame_bytes {
            0 => 1,
            wanted => wanted.saturating_sub(self.size),
        };
        let more = missing.min(bytes.len());
        let end = self.start + self.size;
        if end + more > buffer.len() {
            move_down(buffer, self.start, end);
            self.start = 0;
        }
        copy(part_mut(buffer, self.start + self.size, more), bytes);
        self.size += more;
        more
    }

    pub(crate) fn feed(
        &mut self,
        buffer: &mut [u8],
        bytes: &[u8],
        on_frame: &mut dyn FnMut(Frame<'_>),
    ) {
        // The number of bytes of this call that are also in the buffer.
        let mut taken = 0;
        while self.size > 0 && taken < bytes.len() {
            taken += self.hold(buffer, bytes.get(taken..).unwrap_or_default());
            // Frames that start in the bytes of this call are looked for there.
            let old_bytes = self.size.saturating_sub(taken);
            let held = part(buffer, self.start, self.size);
            let gone = self.run(held, old_bytes, on_frame);
            if gone >= old_bytes {
                taken = gone - old_bytes;
                self.size = 0;
                self.start = 0;
            } else {
                self.start += gone;
                self.size -= gone;
            }
        }
        let rest = bytes.get(taken..).unwrap_or_default();
        if self.size == 0 && !rest.is_empty() {
            let gone = self.run(rest, rest.len(), on_frame);
            let rest = rest.get(gone..).unwrap_or_default();
            copy(buffer, rest);
            self.size = rest.len();
        }
    }
}

/// A decoder of one direction of a link, with its buffer in `[u8; SCHEMA.frame_bytes(DIRECTION)]`.
#[derive(Debug)]
pub struct Decoder<B: ?Sized = [u8]> {
    machine: Machine,
    buffer: B,
}

impl<const BYTES: usize> Decoder<[u8; BYTES]> {
    /// `BYTES` must be at least [`Schema::frame_bytes`]; otherwise every frame is dropped.
    #[must_use]
    pub const fn new(schema: &'static Schema, direction: Direction) -> Self {
        let is_enough = BYTES >= schema.frame_bytes(direction);
        Self { machine: Machine::new(schema, direction, is_enough), buffer: [0; BYTES] }
    }
}

impl<const BYTES: usize> Deref for Decoder<[u8; BYTES]> {
    type Target = Decoder;

    fn deref(&self) -> &Decoder {
        self
    }
}

impl<const BYTES: usize> DerefMut for Decoder<[u8; BYTES]> {
    fn deref_mut(&mut self) -> &mut Decoder {
        self
    }
}

impl Decoder {
    /// Takes the next bytes of the stream and passes on the content of each complete frame.
    pub fn feed(&mut self, bytes: &[u8], on_frame: &mut dyn FnMut(Frame<'_>)) {
        self.machine.feed(&mut self.buffer, bytes, on_frame);
    }

    /// Whether no frame has begun: the next byte is the first of a frame, or garbage.
    #[must_use]
    pub fn is_idle(&self) -> bool {
        self.machine.is_idle()
    }

    /// The frames so far; wraps.
    #[must_use]
    pub fn frames(&self) -> u32 {
        self.machine.frames()
    }

    /// The bytes so far that were in no valid frame; wraps.
    #[must_use]
    pub fn dropped_bytes(&self) -> u32 {
        self.machine.dropped_bytes
    }
}
