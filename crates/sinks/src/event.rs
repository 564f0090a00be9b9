//! What a sink is told, and what it tells: a host's news as owned values, wishes the other way.
//!
//! In: values that passed the rate limit, presence, health. Out: [`Wish`]es. Each sink has a thread of its own, which
//! takes events from a bounded queue, so that a network that hangs stops nothing else.

use std::sync::mpsc::{Receiver, RecvTimeoutError, TryRecvError};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use sensedsl_diagnostics::codes::e0567_program_not_reached::not_reached;
use sensedsl_host::Wish;
use sensedsl_wire::{Health, Scalar, Stamp};

use crate::command::Command;

/// The most wishes that wait for the host: more at a time are of nobody who waits for an answer.
const WISHES_MAX: usize = 256;

/// The least time between two refusals that are told.
const TELL_EVERY: Duration = Duration::from_secs(1);

/// Values of one board that were taken at one time.
#[derive(Clone, Debug, PartialEq)]
pub struct Values {
    /// The place of the board.
    pub board: usize,
    /// When they were taken, since 1970; by the board's stamp where it has one, otherwise when they came.
    pub taken: Duration,
    /// What the board says of the report.
    pub stamp: Option<Stamp>,
    /// How long the report was on its way, as far as that is known.
    pub latency: Option<Duration>,
    /// Whether this is what actuators were set to, and not what sensors measured.
    pub is_command: bool,
    /// The place of each device, and its raw value.
    pub values: Vec<(usize, Vec<Scalar>)>,
}

/// Something that a sink is told.
#[derive(Clone, Debug, PartialEq)]
pub enum Event {
    /// Values came, or were set.
    Values(Values),
    /// A board is there, or is not any more.
    Presence {
        /// The place of the board.
        board: usize,
        /// Why it is not there; none if it is.
        away: Option<String>,
    },
    /// A board has told how it is.
    Health {
        /// The place of the board.
        board: usize,
        /// When it came, since 1970.
        at: Duration,
        /// What it told.
        health: Health,
    },
}

/// What came of waiting for an event.
#[derive(Debug)]
pub enum Next {
    /// An event.
    Event(Event),
    /// None came within the time.
    Nothing,
    /// There will be none.
    Over,
}

/// The end of the queue that a sink reads.
#[derive(Debug)]
pub struct Inbox(pub(crate) Receiver<Event>);

impl Inbox {
    /// Waits for an event.
    #[must_use]
    pub fn next(&self, within: Duration) -> Next {
        match self.0.recv_timeout(within) {
            Ok(event) => Next::Event(event),
            Err(RecvTimeoutError::Timeout) => Next::Nothing,
            Err(RecvTimeoutError::Disconnected) => Next::Over,
        }
    }

    /// The event that is there, if there is one.
    #[must_use]
    pub fn try_next(&self) -> Next {
        match self.0.try_recv() {
            Ok(event) => Next::Event(event),
            Err(TryRecvError::Empty) => Next::Nothing,
            Err(TryRecvError::Disconnected) => Next::Over,
        }
    }
}

/// Where a sink puts what it wants of the host.
#[derive(Clone, Debug)]
pub struct Outbox {
    name: &'static str,
    wishes: Arc<Mutex<Vec<Wish>>>,
    broken: Arc<Mutex<Option<String>>>,
}

impl Outbox {
    /// Of a sink with that name for people.
    #[must_use]
    pub fn new(name: &'static str) -> Self {
        Self { name, wishes: Arc::default(), broken: Arc::default() }
    }

    /// Asks for an actuator to be set.
    ///
    /// # Errors
    /// Fails with the reason, for people, if too many commands wait already.
    pub fn set(&self, command: Command) -> Result<(), String> {
        let Command { board, name, text, .. } = command;
        let is_taken = self.push(Wish::Set { board, name, text });
        if is_taken { Ok(()) } else { Err("too many commands at a time".to_owned()) }
    }

    /// Tells people something.
    pub fn note(&self, text: &str) {
        let _ = self.push(Wish::Note(format!("{}: {text}", self.name)));
    }

    /// It does not work. The same is told once, until [`Self::works`].
    pub fn broken(&self, what: &str, help: &str) {
        let mut broken = self.broken.lock().unwrap_or_else(PoisonError::into_inner);
        if broken.is_none() {
            let what = not_reached(self.name, what);
            let _ = self.push(Wish::Trouble { what, help: help.to_owned() });
            *broken = Some(help.to_owned());
        }
    }

    /// It works. After a time when it did not, that is told.
    pub fn works(&self) {
        let was_broken = self.broken.lock().unwrap_or_else(PoisonError::into_inner).take();
        if was_broken.is_some() {
            self.note("works again");
        }
    }

    /// What is wanted since the last call.
    #[must_use]
    pub fn take(&self) -> Vec<Wish> {
        std::mem::take(&mut *self.wishes.lock().unwrap_or_else(PoisonError::into_inner))
    }

    fn push(&self, wish: Wish) -> bool {
        let mut wishes = self.wishes.lock().unwrap_or_else(PoisonError::into_inner);
        let has_room = wishes.len() < WISHES_MAX;
        if has_room {
            wishes.push(wish);
        }
        has_room
    }
}

/// What was refused: told at most once a second, so that nobody fills the screen from afar.
#[derive(Debug, Default)]
pub struct Refusals {
    told: Option<Instant>,
    waiting: Option<String>,
    skipped: u64,
}

impl Refusals {
    /// Tells of one, now or as soon as it may.
    pub fn tell(&mut self, outbox: &Outbox, text: String) {
        self.skipped += u64::from(self.waiting.replace(text).is_some());
        self.look(outbox);
    }

    /// Tells what had to wait.
    pub fn look(&mut self, outbox: &Outbox) {
        if self.told.is_some_and(|told| told.elapsed() < TELL_EVERY) {
            return;
        }
        let Some(text) = self.waiting.take() else { return };
        let more = match self.skipped {
            0 => String::new(),
            skipped => format!(" ({skipped} more before)"),
        };
        outbox.note(&format!("{text}{more}"));
        *self = Self { told: Some(Instant::now()), ..Self::default() };
    }
}

/// A way to pass values on. It runs in a thread of its own until the inbox is over.
pub trait Sink: Send + 'static {
    /// Takes events, and does not return before there are no more.
    fn run(self: Box<Self>, inbox: &Inbox, outbox: &Outbox);
}
