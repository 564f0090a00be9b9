//! Whether the board at the other end is the one that is meant. No clock and no port in here: time is what the caller
//! says.
//!
//! Nothing is believed before the board's hello has told the hash of this design, for which it is asked until it
//! answers.

use core::time::Duration;

use super::decode::{Decoder, Found};
use super::health::HealthFrame;
use super::wire::{Question, Schema, Stamp, question};

const ASK_EVERY: Duration = Duration::from_millis(250);
const ASK_RARELY_AFTER: Duration = Duration::from_secs(5);
const ASK_RARELY_EVERY: Duration = Duration::from_secs(1);

/// What is known of the board.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum State {
    /// It has not said who it is: nothing is believed.
    Asking,
    /// It is the board that is meant.
    Matched,
    /// A recording cannot be asked: values are believed until a hello says otherwise.
    Playing,
    /// It has the firmware of another design, with this hash.
    Other(u32),
}

/// Something that is believed.
#[derive(Clone, Copy, Debug)]
pub enum Event<'a, S: Schema> {
    /// Firmware and design agree.
    Matched,
    /// The board has the firmware of another design, with this hash.
    Other(u32),
    /// A value, and when the board put its report together, where the link has stamps.
    Message(S::Message, Option<Stamp>),
    /// How the board is.
    Health(HealthFrame<'a, S>),
    /// How the board is, in a version that is not read here.
    OtherHealth(u8),
}

/// A link from its opening to its loss.
#[derive(Clone, Debug)]
pub struct Link<S: Schema> {
    decoder: Decoder<S>,
    state: State,
    since: Option<Duration>,
    asked: Option<Duration>,
    health_asked: Option<Duration>,
    health_every: Option<Duration>,
    wants_health: bool,
    counter: Option<u8>,
    lost: u64,
    withheld: u64,
}

impl<S: Schema> Default for Link<S> {
    fn default() -> Self {
        Self::new()
    }
}

impl<S: Schema> Link<S> {
    /// A link to a board that is asked who it is.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            decoder: Decoder::new(),
            state: State::Asking,
            since: None,
            asked: None,
            health_asked: None,
            health_every: None,
            wants_health: false,
            counter: None,
            lost: 0,
            withheld: 0,
        }
    }

    /// A recording of one.
    #[must_use]
    pub const fn recording() -> Self {
        let mut link = Self::new();
        link.state = State::Playing;
        link
    }

    /// What is known of the board.
    #[must_use]
    pub fn state(&self) -> State {
        self.state
    }

    /// Frames so far.
    #[must_use]
    pub fn frames(&self) -> u64 {
        self.decoder.frames()
    }

    /// Bytes so far that belong to no frame.
    #[must_use]
    pub fn dropped_bytes(&self) -> u64 {
        self.decoder.dropped_bytes()
    }

    /// Reports that the counters of stamps say were lost.
    #[must_use]
    pub fn lost_reports(&self) -> u64 {
        self.lost
    }

    /// Reports that came while nothing was believed.
    #[must_use]
    pub fn withheld_reports(&self) -> u64 {
        self.withheld
    }

    /// Asks how the board is, as soon as it is known.
    pub fn ask_health(&mut self) {
        self.wants_health = true;
    }

    /// Asks how the board is that often.
    pub fn health_every(&mut self, every: Duration) {
        self.health_every = Some(every);
    }

    /// Asks anew who the board is: after a long silence, it may have been restarted with whatever firmware.
    pub fn ask_anew(&mut self) {
        if self.state != State::Playing {
            (self.state, self.since, self.asked, self.counter) = (State::Asking, None, None, None);
        }
    }

    /// What to send now; mostly nothing. To be called some times a second.
    pub fn to_send(&mut self, now: Duration) -> Option<Question> {
        match self.state {
            State::Asking => {
                let since = *self.since.get_or_insert(now);
                let is_rare = now.saturating_sub(since) >= ASK_RARELY_AFTER;
                let every = if is_rare { ASK_RARELY_EVERY } else { ASK_EVERY };
                if self.asked.is_some_and(|asked| now.saturating_sub(asked) < every) {
                    return None;
                }
                self.asked = Some(now);
                Some(question(S::CHECKSUM, false))
            }
            State::Matched => {
                let waited = self.health_asked.map(|asked| now.saturating_sub(asked));
                let is_time = |every: Duration| waited.is_none_or(|waited| waited >= every);
                let is_wanted = self.wants_health && is_time(ASK_RARELY_EVERY);
                if !is_wanted && !self.health_every.is_some_and(is_time) {
                    return None;
                }
                (self.health_asked, self.wants_health) = (Some(now), false);
                Some(question(S::CHECKSUM, true))
            }
            State::Playing | State::Other(_) => None,
        }
    }

    /// Takes the next bytes, however the stream is cut, and hands on what is believed of them.
    #[inline]
    pub fn feed(&mut self, bytes: &[u8], mut on_event: impl FnMut(Event<'_, S>)) {
        let Self { decoder, state, counter, lost, withheld, .. } = self;
        decoder.feed(bytes, |found| {
            let is_believed = matches!(state, State::Matched | State::Playing);
            match found {
                Found::Report(report) if is_believed => {
                    if let Some(stamp) = report.stamp {
                        let gap = counter.map_or(0, |last| stamp.counter.wrapping_sub(last).wrapping_sub(1));
                        *lost += u64::from(gap);
                        *counter = Some(stamp.counter);
                    }
                    report.messages().for_each(|message| on_event(Event::Message(message, report.stamp)));
                }
                Found::Report(_) => *withheld += 1,
                Found::Hello(hash) if hash == S::HASH => {
                    if *state != State::Matched {
                        *state = State::Matched;
                        on_event(Event::Matched);
                    }
                }
                Found::Hello(hash) => {
                    if *state != State::Other(hash) {
                        *state = State::Other(hash);
                        on_event(Event::Other(hash));
                    }
                }
                Found::Health(health) if is_believed => on_event(Event::Health(health)),
                Found::OtherHealth(version) if is_believed => on_event(Event::OtherHealth(version)),
                Found::Health(_) | Found::OtherHealth(_) | Found::HelloRequest | Found::HealthRequest => {}
            }
        });
    }
}
