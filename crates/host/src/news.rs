//! What a host tells those who show, record or forward it, and what they want of it.
//!
//! In: what became of bytes and commands. Out: calls of [`Output`]s, each of which sees the same [`News`] in the same
//! order. An output never blocks: what takes long has a thread and a queue of its own, so that one that hangs stops no
//! other.

use std::time::Duration;

use sensedsl_wire::{Health, Scalar, Stamp};

/// When something happened, by both clocks of the host.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Moment {
    /// Since the run began; it never goes back.
    pub run: Duration,
    /// Since 1970, as the host's clock was set when the run began.
    pub unix: Duration,
}

/// One report of a board.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// What the board says of it, on links with stamps.
    pub stamp: Option<Stamp>,
    /// How long ago the board had put it together when it arrived, as far as the clocks tell.
    pub latency: Option<Duration>,
    /// The place of each device in [`crate::Board::devices`], and its raw value, an element each.
    pub values: Vec<(usize, Vec<Scalar>)>,
}

/// Something that happened.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct News<'a> {
    /// The place of the board among those that are watched.
    pub board: usize,
    /// When it was known.
    pub at: Moment,
    /// What it was.
    pub what: What<'a>,
}

/// What happened.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum What<'a> {
    /// Bytes came, however the stream was cut.
    Received(&'a [u8]),
    /// Bytes were sent.
    Sent(&'a [u8]),
    /// The board is there, and is the one that is meant.
    Online,
    /// Nothing comes of it any more, and why.
    Offline(&'a str),
    /// It has reported.
    Report(&'a Report),
    /// An actuator was set to a raw value, and the frame was sent.
    Command {
        /// The place of the actuator among the devices.
        device: usize,
        /// Its raw value, an element each.
        value: &'a [Scalar],
    },
    /// It has told how it and its devices are.
    Health(&'a Health),
}

/// What an output wants.
#[derive(Clone, Debug, PartialEq)]
pub enum Wish {
    /// An actuator is to be set, to what [`crate::Board::command`] reads.
    Set {
        /// The place of the board.
        board: usize,
        /// The name of the actuator.
        name: String,
        /// The value, as it is shown.
        text: String,
    },
    /// People are to know that it does not work any more.
    Trouble {
        /// What is wrong.
        what: String,
        /// What helps.
        help: String,
    },
    /// People are to know something else.
    Note(String),
}

/// Something that takes what a host knows: a screen, a file, other programs.
pub trait Output {
    /// Takes what happened. It does not block, and keeps what went wrong for the next [`Output::look`].
    fn take(&mut self, news: &News<'_>);

    /// What it wants by now; called some twenty times a second, whether or not something happened.
    fn look(&mut self, now: Moment) -> Vec<Wish>;

    /// Ends it: what it holds goes out. Called once, after everything else.
    fn close(&mut self, now: Moment) -> Vec<Wish>;
}
