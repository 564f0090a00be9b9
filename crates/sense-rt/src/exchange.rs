//! Serial devices that are asked: a request, the echo of it where both directions share a wire, and
//! the answer.
//!
//! Bytes of the line in, values or the reason why there are none out. Who sends and who waits is up
//! to the caller.

use crate::message::{MessageStream, MessageTable};
use crate::outcome::{Outcome, Sink};

/// A request, and the message that answers it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Exchange {
    /// What is sent.
    pub request: &'static [u8],
    /// The answer, with its values.
    pub answer: &'static MessageTable,
    /// The checksum of the answer begins with the request: it is part of the answer's `start`.
    pub is_primed: bool,
    /// The time that the device has for the answer.
    pub wait_ms: u16,
}

/// What is known of an answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Heard {
    /// It is not there yet.
    Waiting,
    /// It is there, and right.
    Answered,
    /// Something else is there.
    Refused,
}

/// The board's own bytes, which it hears where both directions share a wire.
#[derive(Clone, Copy, Debug, Default)]
pub struct Echo {
    heard: usize,
    is_wrong: bool,
}

impl Echo {
    /// Nothing was heard of it yet.
    pub const NEW: Self = Self { heard: 0, is_wrong: false };

    /// The bytes behind the echo of `sent`. One that differs from what was sent was sent by two at
    /// once.
    pub fn behind<'a>(&mut self, sent: &[u8], bytes: &'a [u8]) -> &'a [u8] {
        let left = sent.len().saturating_sub(self.heard).min(bytes.len());
        let wanted = sent.get(self.heard..).unwrap_or_default();
        self.is_wrong |= bytes.iter().zip(wanted).any(|(byte, wanted)| byte != wanted);
        self.heard += left;
        bytes.get(left..).unwrap_or_default()
    }

    /// Whether all that was sent was heard.
    #[must_use]
    pub const fn is_over(&self, sent: &[u8]) -> bool {
        self.heard >= sent.len()
    }

    /// Whether another byte than the sent one was heard.
    #[must_use]
    pub const fn is_wrong(&self) -> bool {
        self.is_wrong
    }
}

/// The bytes that a device says when it has taken a command.
#[derive(Clone, Copy, Debug, Default)]
pub struct Reply {
    heard: usize,
}

impl Reply {
    /// Nothing was heard of it yet.
    pub const NEW: Self = Self { heard: 0 };

    /// Takes the next bytes.
    pub fn take(&mut self, wanted: &[u8], bytes: &[u8]) -> Heard {
        for byte in bytes {
            if wanted.get(self.heard) != Some(byte) {
                return Heard::Refused;
            }
            self.heard += 1;
        }
        if self.heard == wanted.len() { Heard::Answered } else { Heard::Waiting }
    }
}

impl Exchange {
    /// The request is being sent: what comes from now on is the answer.
    pub fn begin(&self, stream: &mut MessageStream) {
        stream.gap();
        if self.is_primed {
            stream.feed(self.request, &mut |_, _, _| {});
        }
    }

    /// Takes the next bytes of the answer, and reports the values or that they were damaged.
    pub fn take(&self, stream: &mut MessageStream, bytes: &[u8], sink: &mut Sink<'_>) -> Heard {
        let before = *stream.counts();
        let mut is_said = false;
        stream.feed(bytes, &mut |item, outcome, value| {
            is_said = true;
            sink(item, outcome, value);
        });
        let now = stream.counts();
        if now.messages != before.messages {
            return Heard::Answered;
        }
        if now.wrong_checksum == before.wrong_checksum {
            return Heard::Waiting;
        }
        if !is_said {
            self.fail(Outcome::WrongCrc, sink);
        }
        Heard::Refused
    }

    /// Reports that there is no answer, for all its values.
    pub fn fail(&self, outcome: Outcome, sink: &mut Sink<'_>) {
        for field in self.answer.fields {
            sink(field.item.into(), outcome, &mut []);
        }
    }
}
