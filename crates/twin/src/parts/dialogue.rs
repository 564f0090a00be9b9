//! Parts on a serial line that answer when they are asked, and remember what they are told.
//!
//! In: the bytes that a board sends, one by one. Out: answers at the line's speed, and the commands that a part has
//! taken. A message for a part that is not there, with a wrong checksum or with another number, is answered by nobody.

use std::collections::VecDeque;

use sensedsl_model::design::{ConnectionIndex, PartIndex};
use sensedsl_model::kind::uart::{Duplex, Uart};

use super::message::{Field, Form, framed};
use crate::truth::Subject;

/// The time from the end of a message to the first bit of its answer.
const TURNAROUND_NS: u64 = 200_000;
/// What is heard is forgotten after so long a silence, besides twenty characters.
const SILENCE_NS: u64 = 2_000_000;
/// More than the longest message.
const HEARD_MAX: usize = 512;

/// A serial line with its parts.
#[derive(Clone, Debug)]
pub(crate) struct Line {
    uart: Uart,
    stations: Vec<Station>,
    heard: Vec<u8>,
    heard_ns: u64,
    /// What is on the way to the board, with the time at which each byte has arrived.
    answer: VecDeque<(u64, u8)>,
    /// Whether the wire for the direction gives the line to the board.
    is_given: bool,
}

/// A part on the line.
#[derive(Clone, Debug)]
pub(crate) struct Station {
    pub(crate) part: PartIndex,
    pub(crate) connection: ConnectionIndex,
    pub(crate) asked: Vec<Asked>,
    pub(crate) told: Vec<Told>,
}

/// A request, and the values of its answer.
#[derive(Clone, Debug)]
pub(crate) struct Asked {
    pub(crate) uart: Uart,
    pub(crate) fields: Vec<Field>,
}

/// A command.
#[derive(Clone, Debug)]
pub(crate) struct Told {
    pub(crate) uart: Uart,
    /// Bytes of the value; none for a text.
    pub(crate) value_bytes: Option<usize>,
}

impl Line {
    pub(crate) const fn new(uart: Uart) -> Self {
        Self {
            uart,
            stations: Vec::new(),
            heard: Vec::new(),
            heard_ns: 0,
            answer: VecDeque::new(),
            is_given: false,
        }
    }

    pub(crate) fn add(&mut self, station: Station) {
        self.stations.push(station);
    }

    /// The time that one round of all parts takes, with some to spare.
    pub(crate) fn round_ns(&self, part: PartIndex) -> Option<u64> {
        self.stations.iter().find(|one| one.part == part)?;
        let asked = |one: &Asked| {
            let own = &one.uart.exchange;
            let body = usize::from(own.body_bytes.unwrap_or(32));
            own.request.len() + body + one.uart.start.len() + 4
        };
        let bytes: usize = self.stations.iter().flat_map(|one| &one.asked).map(asked).sum();
        let exchanges = self.stations.iter().map(|one| one.asked.len() + one.told.len()).sum();
        let count = |number: usize| u64::try_from(number).unwrap_or(u64::MAX);
        Some(count(bytes) * self.byte_ns() + count(exchanges) * 2_000_000)
    }

    fn byte_ns(&self) -> u64 {
        Form { uart: self.uart.clone(), fields: Vec::new() }.byte_ns()
    }

    pub(crate) fn is_at(&self, connection: ConnectionIndex) -> bool {
        self.stations.iter().any(|one| one.connection == connection)
    }

    /// The wire for the direction changes.
    pub(crate) const fn give(&mut self, is_given: bool) {
        self.is_given = is_given;
    }

    /// The board has sent a byte. Returns the command that a part has taken with it.
    pub(crate) fn take(
        &mut self,
        byte: u8,
        subjects: &[Subject],
        is_there: impl Fn(PartIndex) -> bool,
        now_ns: u64,
    ) -> Option<Vec<u8>> {
        if self.uart.exchange.duplex == Duplex::Direction && !self.is_given {
            // Nothing of it reaches the line.
            return None;
        }
        if self.uart.exchange.duplex == Duplex::Joined {
            self.answer.push_back((now_ns, byte));
        }
        if now_ns.saturating_sub(self.heard_ns) > SILENCE_NS + 20 * self.byte_ns() {
            self.heard.clear();
        }
        self.heard_ns = now_ns;
        self.heard.push(byte);
        if self.heard.len() > HEARD_MAX {
            self.heard.remove(0);
        }
        let stations = self.stations.iter().filter(|one| is_there(one.part));
        let found = stations.filter_map(|one| one.understand(&self.heard, subjects, now_ns)).next();
        let (answer, command) = found?;
        self.heard.clear();
        let byte_ns = self.byte_ns();
        let mut at_ns = now_ns + TURNAROUND_NS;
        for byte in answer {
            at_ns += byte_ns;
            self.answer.push_back((at_ns, byte));
        }
        command
    }

    /// The next byte that has arrived at the board.
    pub(crate) fn next(&mut self, now_ns: u64) -> Option<u8> {
        let (at_ns, byte) = *self.answer.front()?;
        if at_ns > now_ns {
            return None;
        }
        self.answer.pop_front();
        // Two that drive the line at once destroy each other's bytes.
        let is_taken = self.uart.exchange.duplex == Duplex::Direction && self.is_given;
        if is_taken { self.next(now_ns) } else { Some(byte) }
    }
}

impl Station {
    /// The answer to what was heard, and the command that it was; none if it means nothing to the part.
    fn understand(
        &self,
        heard: &[u8],
        subjects: &[Subject],
        now_ns: u64,
    ) -> Option<(Vec<u8>, Option<Vec<u8>>)> {
        let asked = self.asked.iter().find(|one| heard.ends_with(&one.uart.exchange.request));
        if let Some(asked) = asked {
            return Some((asked.answer(subjects, now_ns), None));
        }
        self.told.iter().find_map(|told| {
            let message = told.message(heard)?;
            Some((told.uart.exchange.answer.clone(), Some(message.to_vec())))
        })
    }
}

impl Asked {
    fn answer(&self, subjects: &[Subject], now_ns: u64) -> Vec<u8> {
        let own = &self.uart.exchange;
        let mut uart = self.uart.clone();
        uart.length_bytes = own.body_bytes.unwrap_or(0);
        if own.sums_request {
            uart.start.clone_from(&own.request);
        }
        let whole = Form { uart, fields: self.fields.clone() }.compose(subjects, now_ns);
        let before = if own.sums_request { own.request.len() } else { 0 };
        whole.get(before..).unwrap_or_default().to_vec()
    }
}

impl Told {
    /// The message at the end of what was heard.
    fn message<'a>(&self, heard: &'a [u8]) -> Option<&'a [u8]> {
        let Uart { start, end, exchange, checksum, .. } = &self.uart;
        let around =
            start.len() + exchange.behind.len() + end.len() + usize::from(checksum.bytes());
        match self.value_bytes {
            Some(value_bytes) => self.whole(heard, heard.len().checked_sub(around + value_bytes)?),
            None => {
                let last = heard.len().checked_sub(around + 1)?;
                (0..=last).rev().find_map(|at| self.whole(heard, at))
            }
        }
    }

    /// What was heard from a place on, if that is a message with the right checksum.
    fn whole<'a>(&self, heard: &'a [u8], at: usize) -> Option<&'a [u8]> {
        let Uart { start, end, exchange, checksum, .. } = &self.uart;
        let own = heard.get(at..)?;
        let behind = end.len() + usize::from(checksum.bytes()) + exchange.behind.len();
        let body = own.get(start.len()..own.len().checked_sub(behind)?)?;
        let is_number = |byte: &u8| byte.is_ascii_hexdigit() || b"-.,: ".contains(byte);
        let fits = self.value_bytes.is_some() || !body.is_empty() && body.iter().all(is_number);
        let body = [body, exchange.behind.as_slice()].concat();
        (fits && framed(&self.uart, &body) == own).then_some(own)
    }
}
