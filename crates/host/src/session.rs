//! Whether the board at the other end is the one that is meant, and what it says once that is known.
//!
//! In: bytes of the link and the time. Out: bytes to send, and events, but no value before the board's hello has told
//! the schema hash. The hello is asked for until it comes. If the hash is another one, the board's shell is asked for
//! its schema, so that the devices that differ can be named.

use std::sync::OnceLock;
use std::time::Duration;

use sensedsl_wire::{
    Checksum, Decoder, Direction, Event as Received, Health, Scalar, Schema, Stamp,
    encode_health_request, encode_hello_request,
};

use crate::difference::{answered_schema, differences};
use crate::schema::Board;

const ASK_EVERY: Duration = Duration::from_millis(250);
const ASK_RARELY_AFTER: Duration = Duration::from_secs(5);
const ASK_RARELY_EVERY: Duration = Duration::from_secs(1);
const UNANSWERED_AFTER: Duration = Duration::from_millis(1_500);
const SHELL_ANSWERS_WITHIN: Duration = Duration::from_secs(1);
/// `q` brings the shell back from frames; the return before the command ends what was typed.
const SHELL: [(&[u8], Duration); 4] = [
    (b"q", Duration::ZERO),
    (b"\rschema\r", Duration::from_millis(150)),
    (b"q", SHELL_ANSWERS_WITHIN),
    (b"\rschema\r", Duration::from_millis(1_150)),
];
/// The most bytes of a shell's answer that are kept.
const ANSWER_BYTES_MAX: usize = 1 << 16;
/// How long a board may say nothing, if its cycles are shorter.
const SILENCE_MIN: Duration = Duration::from_secs(1);

/// What is known of the board.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum State {
    /// It has not said who it is: nothing is believed.
    Asking,
    /// It is the board that is meant.
    Matched,
    /// A recording has nobody to ask: values are believed until a hello says otherwise.
    Playing,
    /// It is another one: its shell is asked for its schema.
    Comparing,
    /// It is another one, and everything that can be known of it is known.
    Refused,
}

/// Something that a host wants to know.
#[derive(Clone, Debug, PartialEq)]
pub enum Event {
    /// Firmware and schema agree.
    Matched,
    /// Values of a recording come before any hello: nobody knows whether it is this board's.
    Unverified,
    /// It is another board, or has other firmware: the differences, where it could be asked for them.
    Other {
        /// Its hash.
        hash: u32,
        /// A line for each difference; none if it does not say.
        differences: Vec<String>,
    },
    /// Values, each with the place of its device, and the stamp of the report.
    Values(Option<Stamp>, Vec<(usize, Vec<Scalar>)>),
    /// How the board is.
    Health(Health),
    /// How the board is, in a version that is not read here.
    OtherHealth(u8),
    /// It has not answered for long.
    Unanswered,
    /// It said nothing for so long that it is asked anew who it is.
    Silent(Duration),
    /// A device has not reported for so long, although others have.
    Overdue(usize, Duration),
    /// A device reports again after so long.
    Again(usize, Duration),
}

/// What a session has counted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Bytes received.
    pub bytes: u64,
    /// Whole frames.
    pub frames: u64,
    /// Bytes that belonged to no frame.
    pub dropped_bytes: u64,
    /// Reports that came while nothing was believed.
    pub withheld: u64,
    /// Reports that the counters of stamps say were lost.
    pub lost: u64,
}

impl std::ops::AddAssign for Counts {
    fn add_assign(&mut self, other: Self) {
        self.bytes += other.bytes;
        self.frames += other.frames;
        self.dropped_bytes += other.dropped_bytes;
        self.withheld += other.withheld;
        self.lost += other.lost;
    }
}

/// A session with a board, from opening its link to losing it.
#[derive(Clone, Debug)]
pub struct Session<'b> {
    board: &'b Board,
    decoder: Decoder<'b>,
    /// Decoders of hellos with the other two checksums: a board that does not answer may have one of these.
    others: [Decoder<'static>; 2],
    other_hash: Option<u32>,
    state: State,
    is_recording: bool,
    started: Duration,
    asked: Option<Duration>,
    requests: u32,
    is_told_unanswered: bool,
    is_told_unverified: bool,
    shell_step: usize,
    board_hash: u32,
    answer: Vec<u8>,
    last_frame: Duration,
    matched: Duration,
    /// When each device reported last, and whether it was told to be overdue.
    seen: Vec<(Option<Duration>, bool)>,
    counter: Option<u8>,
    health_every: Option<Duration>,
    health_asked: Option<Duration>,
    is_health_wanted: bool,
    counts: Counts,
}

/// The schema of a link without devices.
fn bare(checksum: Checksum) -> &'static Schema {
    static NONE: OnceLock<Schema> = OnceLock::new();
    static CRC16: OnceLock<Schema> = OnceLock::new();
    static CRC32: OnceLock<Schema> = OnceLock::new();
    let place = match checksum {
        Checksum::None => &NONE,
        Checksum::Crc16 => &CRC16,
        Checksum::Crc32 => &CRC32,
    };
    place.get_or_init(|| Schema { checksum, ..Schema::default() })
}

fn others(checksum: Checksum) -> [&'static Schema; 2] {
    match checksum {
        Checksum::None => [bare(Checksum::Crc16), bare(Checksum::Crc32)],
        Checksum::Crc16 => [bare(Checksum::None), bare(Checksum::Crc32)],
        Checksum::Crc32 => [bare(Checksum::None), bare(Checksum::Crc16)],
    }
}

impl<'b> Session<'b> {
    /// A session that asks the board who it is.
    #[must_use]
    pub fn new(board: &'b Board, now: Duration) -> Self {
        let others = others(board.schema.checksum);
        Self {
            board,
            decoder: Decoder::new(&board.schema, Direction::Sensor),
            others: others.map(|schema| Decoder::new(schema, Direction::Sensor)),
            other_hash: None,
            state: State::Asking,
            is_recording: false,
            started: now,
            asked: None,
            requests: 0,
            is_told_unanswered: false,
            is_told_unverified: false,
            shell_step: 0,
            board_hash: 0,
            answer: Vec::new(),
            last_frame: now,
            matched: now,
            seen: vec![(None, false); board.devices.len()],
            counter: None,
            health_every: None,
            health_asked: None,
            is_health_wanted: false,
            counts: Counts::default(),
        }
    }

    /// A session with a recording, which cannot be asked.
    #[must_use]
    pub fn recording(board: &'b Board) -> Self {
        let mut session = Self::new(board, Duration::ZERO);
        session.is_recording = true;
        session.state = State::Playing;
        session
    }

    /// What is known of the board.
    #[must_use]
    pub fn state(&self) -> State {
        self.state
    }

    /// What was counted so far.
    #[must_use]
    pub fn counts(&self) -> Counts {
        let (frames, dropped_bytes) = (self.decoder.frames(), self.decoder.dropped_bytes());
        Counts { frames, dropped_bytes, ..self.counts }
    }

    /// Asks for health that often from now on.
    pub fn health_every(&mut self, every: Duration) {
        self.health_every = Some(every);
    }

    /// When a device reported last.
    #[must_use]
    pub fn last_seen(&self, device: usize) -> Option<Duration> {
        self.seen.get(device)?.0
    }

    /// Whether a device has not reported for three of its cycles and a bit.
    #[must_use]
    pub fn is_overdue(&self, device: usize, now: Duration) -> bool {
        let since = self.last_seen(device).unwrap_or(self.matched);
        self.limit(device).is_some_and(|limit| now.saturating_sub(since) > limit)
    }

    /// Takes the next bytes, however the stream is cut.
    pub fn feed(&mut self, bytes: &[u8], now: Duration, on_event: &mut dyn FnMut(Event)) {
        self.counts.bytes += bytes.len() as u64;
        if self.state == State::Comparing {
            let room = ANSWER_BYTES_MAX.saturating_sub(self.answer.len());
            self.answer.extend(bytes.iter().take(room));
            self.compare(now, on_event);
        }
        if self.state == State::Asking {
            self.listen_for_others(bytes, now);
        }
        let mut received = Vec::new();
        self.decoder.feed(bytes, |event| received.push(event));
        for event in received {
            self.take(event, now, on_event);
        }
    }

    /// What to send now; mostly nothing.
    pub fn to_send(&mut self, now: Duration) -> Vec<u8> {
        match self.state {
            State::Asking => self.request(now),
            State::Matched => self.ask_for_health(now),
            State::Comparing => self.shell_command(now),
            State::Playing | State::Refused => Vec::new(),
        }
    }

    /// Notices what does not come; to be called a few times a second.
    pub fn look(&mut self, now: Duration, on_event: &mut dyn FnMut(Event)) {
        match self.state {
            State::Asking => {
                let is_late = now.saturating_sub(self.started) >= UNANSWERED_AFTER;
                if is_late && !self.is_told_unanswered {
                    self.is_told_unanswered = true;
                    on_event(Event::Unanswered);
                }
            }
            State::Matched => self.look_for_silence(now, on_event),
            State::Comparing => self.compare(now, on_event),
            State::Playing | State::Refused => {}
        }
    }

    fn request(&mut self, now: Duration) -> Vec<u8> {
        let is_rare = now.saturating_sub(self.started) >= ASK_RARELY_AFTER;
        let every = if is_rare { ASK_RARELY_EVERY } else { ASK_EVERY };
        if self.asked.is_some_and(|asked| now.saturating_sub(asked) < every) {
            return Vec::new();
        }
        self.asked = Some(now);
        self.requests = self.requests.wrapping_add(1);
        // A board that does not answer may have another form of frames.
        let [first, second] = others(self.board.schema.checksum);
        let other = if self.requests.is_multiple_of(2) { second } else { first };
        let is_other = self.requests.is_multiple_of(3);
        encode_hello_request(if is_other { other } else { &self.board.schema })
    }

    fn ask_for_health(&mut self, now: Duration) -> Vec<u8> {
        let waited = self.health_asked.map(|asked| now.saturating_sub(asked));
        let is_time = |every: Duration| waited.is_none_or(|waited| waited >= every);
        let is_wanted = self.is_health_wanted && is_time(Duration::from_secs(1));
        if !is_wanted && !self.health_every.is_some_and(is_time) {
            return Vec::new();
        }
        self.health_asked = Some(now);
        self.is_health_wanted = false;
        encode_health_request(&self.board.schema)
    }

    fn shell_command(&mut self, now: Duration) -> Vec<u8> {
        let Some((command, at)) = SHELL.get(self.shell_step) else { return Vec::new() };
        if now.saturating_sub(self.started) < *at {
            return Vec::new();
        }
        self.shell_step += 1;
        command.to_vec()
    }

    /// Ends the comparison once the shell has answered, or will not any more.
    fn compare(&mut self, now: Duration, on_event: &mut dyn FnMut(Event)) {
        let answer = answered_schema(&self.answer, self.board_hash);
        let is_over = now.saturating_sub(self.started) >= 2 * SHELL_ANSWERS_WITHIN;
        if answer.is_none() && !is_over {
            return;
        }
        let own = self.board.schema.canonical_text();
        let differences = answer.map(|board| differences(&own, &board)).unwrap_or_default();
        self.state = State::Refused;
        on_event(Event::Other { hash: self.board_hash, differences });
    }

    /// Bytes of a value may look like a hello; two equal ones are one.
    fn listen_for_others(&mut self, bytes: &[u8], now: Duration) {
        let mut hashes = Vec::new();
        for decoder in &mut self.others {
            decoder.feed(bytes, |event| {
                if let Received::Hello(hash) = event {
                    hashes.push(hash);
                }
            });
        }
        for hash in hashes {
            if self.other_hash == Some(hash) {
                self.is_another(hash, now);
            }
            self.other_hash = Some(hash);
        }
    }

    fn is_another(&mut self, hash: u32, now: Duration) {
        self.board_hash = hash;
        self.answer.clear();
        self.shell_step = 0;
        self.started = now;
        self.state = State::Comparing;
    }

    fn take(&mut self, event: Received, now: Duration, on_event: &mut dyn FnMut(Event)) {
        self.last_frame = now;
        match event {
            Received::Hello(hash) => self.hello(hash, now, on_event),
            Received::Report(stamp, values) => self.report(stamp, values, now, on_event),
            Received::Health(health) if self.is_believed() => on_event(Event::Health(health)),
            Received::OtherHealth(version) if self.is_believed() => {
                on_event(Event::OtherHealth(version));
            }
            Received::Health(_)
            | Received::OtherHealth(_)
            | Received::HelloRequest
            | Received::HealthRequest => {}
        }
    }

    fn is_believed(&self) -> bool {
        matches!(self.state, State::Matched | State::Playing)
    }

    fn hello(&mut self, hash: u32, now: Duration, on_event: &mut dyn FnMut(Event)) {
        if hash == self.board.schema.hash() {
            if matches!(self.state, State::Asking | State::Playing) {
                self.state = State::Matched;
                self.matched = now;
                self.is_health_wanted = !self.is_recording;
                on_event(Event::Matched);
            }
        } else if self.is_recording {
            self.state = State::Refused;
            on_event(Event::Other { hash, differences: Vec::new() });
        } else if !matches!(self.state, State::Comparing | State::Refused) {
            self.is_another(hash, now);
        }
    }

    fn report(
        &mut self,
        stamp: Option<Stamp>,
        values: Vec<(u8, Vec<Scalar>)>,
        now: Duration,
        on_event: &mut dyn FnMut(Event),
    ) {
        if !self.is_believed() {
            self.counts.withheld += 1;
            return;
        }
        if self.state == State::Playing && !self.is_told_unverified {
            self.is_told_unverified = true;
            on_event(Event::Unverified);
        }
        if let Some(Stamp { counter, .. }) = stamp {
            let gap = self.counter.map_or(0, |last| counter.wrapping_sub(last).wrapping_sub(1));
            self.counts.lost += u64::from(gap);
            self.counter = Some(counter);
        }
        let mut placed = Vec::with_capacity(values.len());
        for (id, value) in values {
            let Some(device) = self.board.device(Direction::Sensor, id) else { continue };
            if let Some((seen, is_told)) = self.seen.get_mut(device) {
                if *is_told {
                    let since = seen.unwrap_or(self.matched).max(self.matched);
                    on_event(Event::Again(device, now.saturating_sub(since)));
                }
                (*seen, *is_told) = (Some(now), false);
            }
            placed.push((device, value));
        }
        on_event(Event::Values(stamp, placed));
    }

    /// The age from which on a value is overdue; none for devices without a cycle.
    fn limit(&self, device: usize) -> Option<Duration> {
        let device = self.board.devices.get(device)?;
        let cycle = device.cycle_ms.filter(|_| device.direction == Direction::Sensor)?;
        Some(3 * Duration::from_millis(cycle.into()) + Duration::from_millis(100))
    }

    /// A device that is overdue while others report is told. Where nothing comes at all, the board is asked anew: it
    /// may have been restarted, with whatever firmware.
    fn look_for_silence(&mut self, now: Duration, on_event: &mut dyn FnMut(Event)) {
        if self.is_recording {
            return;
        }
        let limits: Vec<Option<Duration>> =
            (0..self.board.devices.len()).map(|device| self.limit(device)).collect();
        for (device, limit) in limits.iter().enumerate() {
            let (Some(limit), Some((seen, is_told))) = (limit, self.seen.get_mut(device)) else {
                continue;
            };
            let since = seen.unwrap_or(self.matched).max(self.matched);
            if !*is_told && self.last_frame > since + *limit {
                *is_told = true;
                self.is_health_wanted = true;
                on_event(Event::Overdue(device, now.saturating_sub(since)));
            }
        }
        let Some(shortest) = limits.into_iter().flatten().min() else { return };
        let silence = now.saturating_sub(self.last_frame.max(self.matched));
        if silence > shortest.max(SILENCE_MIN) {
            self.state = State::Asking;
            (self.started, self.asked, self.requests) = (now, None, 0);
            // What was told of the silence is enough.
            self.is_told_unanswered = true;
            on_event(Event::Silent(silence));
        }
    }
}
