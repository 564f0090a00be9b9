//! A board on a serial port, or in a recording: messages in, commands out, and what happens to it.

use std::collections::VecDeque;
use std::io::{self, Read};
use std::sync::OnceLock;
use std::time::{Duration, Instant};

use sensedsl_host::port::{self, Identity, Port};
use sensedsl_host::{answered_schema, differences};
use sensedsl_wire::{Checksum as BareChecksum, Decoder as Other, Direction, Event as OtherEvent, Schema as BareSchema};

use super::link::{Event, Link, State};
use super::message::{AnyMessage, Device};
use super::outcome::{BoardHealth, Counts, Error, Received};
use super::wire::{Schema, encode, question};

const STEP: Duration = Duration::from_millis(20);
const ANSWERS_WITHIN: Duration = Duration::from_millis(1_500);
const TRY_AGAIN_EVERY: Duration = Duration::from_millis(250);
const SILENCE_MIN: Duration = Duration::from_secs(1);
const SHELL_WITHIN: Duration = Duration::from_secs(2);
/// What brings a board's schema, and when it is typed: `q` ends frames and brings the shell back.
const SHELL: [(u64, &[u8]); 4] = [(0, b"q"), (150, b"\rschema\r"), (1_000, b"q"), (1_150, b"\rschema\r")];
const ANSWER_BYTES_MAX: usize = 1 << 16;
const FRAME_BYTES_MAX: usize = 1 << 16;

enum Source {
    Port(Port),
    Recording(Box<dyn Read + Send>),
    /// It is gone since then.
    Lost(Instant),
}

/// Another board's firmware, while its shell is asked for its schema.
struct Comparing {
    hash: u32,
    since: Instant,
    step: usize,
    answer: Vec<u8>,
}

/// A board of the design `S`.
pub struct Board<S: Schema> {
    source: Source,
    path: String,
    baud: u32,
    identity: Option<Identity>,
    link: Link<S>,
    before: Counts,
    start: Instant,
    others: Vec<Other<'static>>,
    other_hash: Option<u32>,
    asked: usize,
    comparing: Option<Comparing>,
    heard: Instant,
    sent: Instant,
    has_sent: bool,
    is_told: bool,
    tried: Instant,
    queue: VecDeque<Received<S::Message>>,
    latest: Vec<Received<S::Message>>,
    health: Option<BoardHealth>,
    on_note: Box<dyn FnMut(&str) + Send>,
    hold: bool,
    reconnect: bool,
    is_over: bool,
}

/// Decoders of hellos with any checksum: a board that does not answer may have another one than is expected.
fn others() -> Vec<Other<'static>> {
    static BARE: OnceLock<[BareSchema; 3]> = OnceLock::new();
    let bare = BARE.get_or_init(|| BareChecksum::ALL.map(|checksum| BareSchema { checksum, ..BareSchema::default() }));
    bare.iter().map(|schema| Other::new(schema, Direction::Sensor)).collect()
}

impl<S: Schema> Board<S> {
    /// Opens the board at a serial port.
    ///
    /// # Errors
    /// Fails if the port is not there, not a serial port, in use, or not this user's.
    pub fn open(path: &str) -> Result<Self, Error> {
        Self::open_at(path, S::BAUD)
    }

    /// Opens the board at a serial port of another rate than the design's.
    ///
    /// # Errors
    /// Fails as [`Board::open`] does.
    pub fn open_at(path: &str, baud: u32) -> Result<Self, Error> {
        let port = Port::open(path, baud).map_err(|why| Error::Open(path.to_owned(), why))?;
        let identity = port.identity().cloned();
        Ok(Self::new(Source::Port(port), path.to_owned(), baud, identity, Link::new()))
    }

    /// Opens the first USB port that answers as this board.
    ///
    /// # Errors
    /// Fails if none does; the error has what each of them is.
    pub fn find() -> Result<Self, Error> {
        let mut tried = Vec::new();
        for (path, identity) in port::usb_ports() {
            match Self::open(&path).and_then(Self::answered) {
                Ok(board) => return Ok(board),
                Err(error) => tried.push(format!("{path} ({identity}): {error}")),
            }
        }
        Err(Error::NotFound(tried))
    }

    /// Reads what was recorded of a board's link.
    pub fn play(recording: impl Read + Send + 'static) -> Self {
        Self::new(Source::Recording(Box::new(recording)), String::new(), 0, None, Link::recording())
    }

    fn new(source: Source, path: String, baud: u32, identity: Option<Identity>, link: Link<S>) -> Self {
        let now = Instant::now();
        Self {
            source,
            path,
            baud,
            identity,
            link,
            before: Counts::default(),
            start: now,
            others: others(),
            other_hash: None,
            asked: 0,
            comparing: None,
            heard: now,
            sent: now,
            has_sent: false,
            is_told: false,
            tried: now,
            queue: VecDeque::new(),
            latest: Vec::new(),
            health: None,
            on_note: Box::new(|note| eprintln!("{note}")),
            hold: true,
            reconnect: true,
            is_over: false,
        }
    }

    /// Where notes for people go: a board that is lost, one that is back. Standard error unless this says otherwise.
    pub fn on_note(&mut self, on_note: impl FnMut(&str) + Send + 'static) {
        self.on_note = Box::new(on_note);
    }

    /// Whether a device that goes is waited for; so it is unless this says otherwise.
    pub fn reconnect(&mut self, is_on: bool) {
        self.reconnect = is_on;
    }

    /// Whether actuators keep what they were told as long as messages are asked for, whatever their failsafe; so they
    /// do unless this says otherwise.
    pub fn hold(&mut self, is_on: bool) {
        self.hold = is_on;
    }

    /// Asks how the board is that often; [`Board::last_health`] has the answer.
    pub fn health_every(&mut self, every: Duration) {
        self.link.health_every(every);
    }

    /// Whether the board is there and has this design's firmware.
    #[must_use]
    pub fn is_ready(&self) -> bool {
        !matches!(self.source, Source::Lost(_)) && matches!(self.link.state(), State::Matched | State::Playing)
    }

    /// Whether a recording is over, or the board is gone and not waited for.
    #[must_use]
    pub fn is_over(&self) -> bool {
        self.is_over && self.queue.is_empty()
    }

    /// What was counted.
    #[must_use]
    pub fn counts(&self) -> Counts {
        Counts {
            frames: self.before.frames + self.link.frames(),
            dropped_bytes: self.before.dropped_bytes + self.link.dropped_bytes(),
            lost_reports: self.before.lost_reports + self.link.lost_reports(),
        }
    }

    /// The latest message of a device, and what is known of it.
    #[must_use]
    pub fn latest<D: Device + TryFrom<S::Message>>(&self) -> Option<Received<D>> {
        let found = self.latest.iter().find(|one| one.message.facts().id == D::FACTS.id)?;
        Some(Received { message: D::try_from(found.message).ok()?, at: found.at, stamp: found.stamp })
    }

    /// Whether a sensor was silent for three of its cycles.
    #[must_use]
    pub fn is_overdue<D: Device + TryFrom<S::Message>>(&self) -> bool {
        let Some(cycle_ms) = D::FACTS.cycle_ms else { return false };
        let limit = 3 * Duration::from_millis(cycle_ms.into()) + Duration::from_millis(100);
        self.latest::<D>().is_none_or(|one| one.at.elapsed() > limit)
    }

    /// The next message, if one comes within a time. None as well when a recording is over.
    ///
    /// # Errors
    /// Fails if the board has other firmware, or if it is gone and not waited for.
    pub fn next_within(&mut self, within: Duration) -> Result<Option<Received<S::Message>>, Error> {
        let end = Instant::now() + within;
        loop {
            if let Some(received) = self.queue.pop_front() {
                return Ok(Some(received));
            }
            let left = end.saturating_duration_since(Instant::now());
            if self.is_over || left.is_zero() {
                return Ok(None);
            }
            self.poll(left.min(STEP))?;
        }
    }

    /// Sets an actuator. Waits for a board that has not said yet who it is.
    ///
    /// # Errors
    /// Fails beyond limits of the design, or if there is no such board in time.
    pub fn send(&mut self, message: impl Into<S::Message>) -> Result<(), Error> {
        self.send_all(&[message.into()])
    }

    /// Sets several actuators at once.
    ///
    /// # Errors
    /// Fails as [`Board::send`] does.
    pub fn send_all(&mut self, messages: &[S::Message]) -> Result<(), Error> {
        if let Some(refused) = messages.iter().find_map(AnyMessage::refused) {
            return Err(refused.into());
        }
        let mut memory = vec![0; FRAME_BYTES_MAX];
        let frame = encode::<S>(messages, &mut memory)?.to_vec();
        let end = Instant::now() + 2 * ANSWERS_WITHIN;
        while !self.is_ready() {
            if self.is_over || Instant::now() >= end {
                return Err(Error::Silent(S::NAME));
            }
            self.poll(STEP)?;
        }
        self.write(&frame)?;
        self.has_sent = true;
        let at = Instant::now();
        messages.iter().for_each(|message| self.note(Received { message: *message, at, stamp: None }));
        Ok(())
    }

    /// How the board said it is when it was asked last.
    #[must_use]
    pub fn last_health(&self) -> Option<&BoardHealth> {
        self.health.as_ref()
    }

    /// Asks how the board is.
    ///
    /// # Errors
    /// Fails if it does not answer in time.
    pub fn health(&mut self, within: Duration) -> Result<BoardHealth, Error> {
        self.health = None;
        let end = Instant::now() + within;
        loop {
            if let Some(health) = &self.health {
                return Ok(health.clone());
            }
            if self.is_over || Instant::now() >= end {
                return Err(Error::Silent(S::NAME));
            }
            self.link.ask_health();
            self.poll(STEP)?;
        }
    }

    /// This board once it has said who it is.
    fn answered(mut self) -> Result<Self, Error> {
        let end = Instant::now() + ANSWERS_WITHIN;
        while !self.is_ready() {
            if Instant::now() >= end && self.comparing.is_none() {
                return Err(Error::Silent(S::NAME));
            }
            self.poll(STEP)?;
        }
        Ok(self)
    }

    fn poll(&mut self, within: Duration) -> Result<(), Error> {
        if let Source::Lost(since) = self.source {
            self.find_again(since, within);
            return Ok(());
        }
        self.speak()?;
        let read = match &mut self.source {
            Source::Port(port) => port.read(within),
            Source::Recording(recording) => {
                let mut bytes = vec![0; 4_096];
                let read = recording.read(&mut bytes);
                self.is_over = !matches!(read, Ok(1..));
                read.map(|count| bytes.into_iter().take(count).collect())
            }
            Source::Lost(_) => Ok(Vec::new()),
        };
        match read {
            Ok(bytes) => self.hear(&bytes),
            Err(error) => self.lose(&error),
        }
    }

    /// Sends what is due: questions, what is typed to a shell, and frames that hold commands.
    fn speak(&mut self) -> Result<(), Error> {
        let now = self.start.elapsed();
        if let Some(comparing) = &mut self.comparing {
            if let Some((at, typed)) = SHELL.get(comparing.step)
                && comparing.since.elapsed() >= Duration::from_millis(*at)
            {
                comparing.step += 1;
                return self.write(typed);
            }
            return Ok(());
        }
        if let Some(question) = self.link.to_send(now) {
            if self.link.state() == State::Asking {
                self.asked += 1;
                // A board that does not answer may have frames of another form.
                if self.asked.is_multiple_of(3) {
                    let others = [super::Checksum::None, super::Checksum::Crc16, super::Checksum::Crc32];
                    let other = others.get(self.asked / 3 % others.len()).copied().unwrap_or(S::CHECKSUM);
                    return self.write(super::question(other, false).as_ref());
                }
            }
            return self.write(question.as_ref());
        }
        let silence = S::SILENCE_MS.map(|silence| Duration::from_millis(silence.into()) / 3);
        let is_held = self.hold && self.has_sent && self.link.state() == State::Matched;
        if is_held && silence.is_some_and(|silence| self.sent.elapsed() >= silence) {
            return self.write(question(S::CHECKSUM, false).as_ref());
        }
        Ok(())
    }

    fn hear(&mut self, bytes: &[u8]) -> Result<(), Error> {
        if !bytes.is_empty() {
            self.heard = Instant::now();
        }
        let hash = self.comparing.as_ref().map(|comparing| comparing.hash).or_else(|| self.listen(bytes));
        if let Some(hash) = hash {
            return self.compare(hash, bytes);
        }
        let (at, mut is_other, mut messages, mut health) = (Instant::now(), None, Vec::new(), None);
        self.link.feed(bytes, |event| match event {
            Event::Matched | Event::OtherHealth(_) => {}
            Event::Other(hash) => is_other = Some(hash),
            Event::Message(message, stamp) => messages.push(Received { message, at, stamp }),
            Event::Health(frame) => {
                health = Some(BoardHealth { board: frame.board(), devices: frame.devices().collect() });
            }
        });
        self.health = health.or(self.health.take());
        for message in messages {
            self.note(message);
            self.queue.push_back(message);
        }
        match is_other {
            Some(hash) if matches!(self.source, Source::Recording(_)) => Err(Error::OtherFirmware(hash, Vec::new())),
            Some(hash) => self.compare(hash, &[]),
            None => {
                self.look();
                Ok(())
            }
        }
    }

    fn note(&mut self, received: Received<S::Message>) {
        let id = received.message.facts().id;
        match self.latest.iter_mut().find(|one| one.message.facts().id == id) {
            Some(one) => *one = received,
            None => self.latest.push(received),
        }
    }

    /// The hash in a hello with whatever checksum, while the board is asked: bytes of a value may look like one, so two
    /// equal ones count.
    fn listen(&mut self, bytes: &[u8]) -> Option<u32> {
        if self.link.state() != State::Asking {
            return None;
        }
        let mut hashes = Vec::new();
        for decoder in &mut self.others {
            decoder.feed(bytes, |event| {
                if let OtherEvent::Hello(hash) = event {
                    hashes.push(hash);
                }
            });
        }
        let mut found = None;
        for hash in hashes.into_iter().filter(|hash| *hash != S::HASH) {
            found = found.or((self.other_hash == Some(hash)).then_some(hash));
            self.other_hash = Some(hash);
        }
        found
    }

    /// Asks the shell of a board with other firmware for its schema, and ends with what differs.
    fn compare(&mut self, hash: u32, bytes: &[u8]) -> Result<(), Error> {
        let begin = || Comparing { hash, since: Instant::now(), step: 0, answer: Vec::new() };
        let comparing = self.comparing.get_or_insert_with(begin);
        let room = ANSWER_BYTES_MAX.saturating_sub(comparing.answer.len());
        comparing.answer.extend(bytes.iter().take(room));
        let answer = answered_schema(&comparing.answer, hash);
        if answer.is_none() && comparing.since.elapsed() < SHELL_WITHIN {
            return Ok(());
        }
        let lines = answer.map(|board| differences(S::TEXT, &board)).unwrap_or_default();
        Err(Error::OtherFirmware(hash, lines))
    }

    /// Tells of a board that does not answer, and asks one anew that has said nothing for long.
    fn look(&mut self) {
        let is_port = matches!(self.source, Source::Port(_));
        let is_asking = self.link.state() == State::Asking;
        if is_port && is_asking && !self.is_told && self.heard.elapsed().max(self.start.elapsed()) >= ANSWERS_WITHIN {
            self.is_told = true;
            (self.on_note)(&format!("{} does not say who it is: has it the firmware of this design?", self.path));
        }
        let cycles = S::ITEMS.iter().any(|item| item.is_sensor);
        if is_port && !is_asking && cycles && self.heard.elapsed() > SILENCE_MIN {
            self.link.ask_anew();
            self.heard = Instant::now();
        }
    }

    fn write(&mut self, bytes: &[u8]) -> Result<(), Error> {
        self.sent = Instant::now();
        match &mut self.source {
            Source::Port(port) => match port.write(bytes) {
                Ok(()) => Ok(()),
                Err(error) => self.lose(&error),
            },
            Source::Recording(_) | Source::Lost(_) => Ok(()),
        }
    }

    fn lose(&mut self, error: &io::Error) -> Result<(), Error> {
        let gone = Error::Gone(format!("{}: {error}", self.path));
        if !self.reconnect || matches!(self.source, Source::Recording(_)) {
            self.is_over = true;
            return Err(gone);
        }
        (self.on_note)(&format!("lost {}: {error}", self.path));
        self.before = self.counts();
        self.link = Link::new();
        self.others = others();
        (self.source, self.comparing, self.other_hash) = (Source::Lost(Instant::now()), None, None);
        Ok(())
    }

    /// Looks for a board that is gone: a USB device under any name, another one under its own.
    fn find_again(&mut self, since: Instant, within: Duration) {
        std::thread::sleep(within);
        if self.tried.elapsed() < TRY_AGAIN_EVERY {
            return;
        }
        self.tried = Instant::now();
        let path = match &self.identity {
            Some(identity) => port::find(identity),
            None => Some(self.path.clone()),
        };
        if let Some(path) = path
            && let Ok(port) = Port::open(&path, self.baud)
        {
            self.source = Source::Port(port);
            (self.start, self.heard, self.is_told) = (Instant::now(), Instant::now(), false);
            (self.on_note)(&format!("back on {path} after {:.1} s", since.elapsed().as_secs_f64()));
            self.path = path;
        }
    }
}

impl<S: Schema> Iterator for Board<S> {
    type Item = Result<Received<S::Message>, Error>;

    /// Waits for the next message. None when a recording is over, and after an error.
    fn next(&mut self) -> Option<Self::Item> {
        while !self.is_over {
            let next = self.next_within(Duration::from_secs(1));
            self.is_over |= next.is_err();
            if let Some(one) = next.transpose() {
                return Some(one);
            }
        }
        self.queue.pop_front().map(Ok)
    }
}
