//! What a serial part is asked and told: the properties of requests, of answers, and of wires that several parts share.
//!
//! In: the properties of a device, and the frame of its messages. Out: an [`Exchange`], with all bytes that are known
//! before a value is: addresses are in their places, and checksums are computed.

use super::{MessageChecksum, SUMS_BEHIND};
use crate::fields::Fields;
use crate::meaning::{Meaning, Takes, first};
use crate::value::Value;
use sensedsl_wire::Direction;

/// The word that stands for the part's address in a list of bytes.
pub(crate) const ADDRESS: &str = "address";
/// The time that a part has for its answer if the file gives none.
const WAIT_DEFAULT_MS: u32 = 10;

/// What the properties of exchanges mean.
pub(super) const MEANINGS: [Meaning; 10] = [
    Meaning::new(
        (ADDRESS, Takes::Whole(0, 254)),
        "none",
        "The number by which a part is told from others on the same wires. The word stands for it in `start`, \
         `request`, `answer`, `behind` and `init`.",
        "address = 3;",
    ),
    Meaning::new(
        ("duplex", Takes::Words(|| first(&DUPLEXES))),
        "`full`",
        "How the part is wired. `full`: TX and RX. `half`: both directions on one wire at TX. `joined`: TX and RX are \
         joined outside of the MCU. `direction`: TX, RX, and a wire that is high while the board sends.",
        "duplex = half;",
    ),
    Meaning::new(
        ("request", Takes::Bytes(1, 24)),
        "none: the part speaks by itself",
        "What is sent in each cycle so that the part answers with the value.",
        "request = [0x55];",
    )
    .only(Direction::Sensor),
    Meaning::new(
        ("request_checksum", Takes::Words(|| first(SUMS_BEHIND))),
        "as `checksum`",
        "What stands after `request`.",
        "request_checksum = none;",
    ),
    Meaning::new(
        ("request_end", Takes::Bytes(0, 8)),
        "none",
        "What stands after the checksum of `request`.",
        "request_end = [0x03];",
    ),
    Meaning::new(
        ("body", Takes::Whole(1, 255)),
        "up to `end`",
        "Bytes of the answer to `request` between its `start` and its checksum.",
        "body = 4;",
    ),
    Meaning::new(
        ("sums_request", Takes::Truth),
        "`false`",
        "The checksum of an answer is of the request and the answer together, and the answer has no `start`.",
        "sums_request = true;",
    ),
    Meaning::new(
        ("answer", Takes::Bytes(1, 16)),
        "none: nothing is awaited",
        "What a part says when it has taken a command, without the checksum; anything else is a fault.",
        "answer = [0xFF];",
    ),
    Meaning::new(
        ("answer_checksum", Takes::Words(|| first(SUMS_BEHIND))),
        "as `checksum`",
        "What stands after `answer`.",
        "answer_checksum = none;",
    ),
    Meaning::new(
        ("behind", Takes::Bytes(0, 16)),
        "none",
        "What stands between the value of a command and its checksum.",
        "behind = [0x00, 0x00];",
    ),
];

/// How a part's wires carry both directions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Duplex {
    /// A wire for each.
    #[default]
    Full,
    /// One wire at TX.
    Half,
    /// TX and RX, joined outside of the MCU.
    Joined,
    /// TX and RX, and a wire that says which of them has the line.
    Direction,
}

/// The words after `duplex`.
pub(super) const DUPLEXES: [(&str, Duplex); 4] = [
    ("full", Duplex::Full),
    ("half", Duplex::Half),
    ("joined", Duplex::Joined),
    ("direction", Duplex::Direction),
];

impl Duplex {
    /// Whether the board hears what it sends.
    #[must_use]
    pub const fn has_echo(self) -> bool {
        matches!(self, Self::Half | Self::Joined)
    }

    /// A number that is different for each.
    #[must_use]
    pub const fn number(self) -> u32 {
        match self {
            Self::Full => 0,
            Self::Half => 1,
            Self::Joined => 2,
            Self::Direction => 3,
        }
    }
}

/// What a part is asked or told, besides its value.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Exchange {
    /// The number by which it is told from others on its wires; none where it has them for itself.
    pub address: Option<u8>,
    /// Where that is given.
    pub address_span: Option<sensedsl_diagnostics::Span>,
    /// How both directions are wired.
    pub duplex: Duplex,
    /// What is sent for the value, with its checksum and its end; empty for a part that speaks by itself.
    pub request: Vec<u8>,
    /// Bytes of the answer's body; none up to `end`.
    pub body_bytes: Option<u16>,
    /// Whether the answer's checksum begins with the request.
    pub sums_request: bool,
    /// What a part says when it has taken a command, with its checksum; empty if nothing is awaited.
    pub answer: Vec<u8>,
    /// The time that the part has for an answer.
    pub wait_ms: u32,
    /// What stands between the value of a command and its checksum.
    pub behind: Vec<u8>,
    /// The time after which a command is sent again; 0 for never.
    pub resend_ms: u32,
}

impl Exchange {
    /// Whether the board waits for the part, or shares its wires: it then speaks with one part at a time.
    #[must_use]
    pub fn is_dialogue(&self) -> bool {
        let is_asked = !self.request.is_empty() || !self.answer.is_empty();
        is_asked || self.resend_ms > 0 || self.address.is_some() || self.duplex != Duplex::Full
    }
}

/// The frame of a message, which its request has too.
pub(super) struct Frame {
    pub(super) has_end: bool,
    pub(super) checksum: MessageChecksum,
    pub(super) from: usize,
}

/// The part's address, which lists of bytes name.
pub(super) fn address(fields: &mut Fields<'_>) -> (Option<u8>, Option<sensedsl_diagnostics::Span>) {
    let address = fields.integer(ADDRESS, 0..=254);
    let number = address.and_then(|n| u8::try_from(n.value).ok());
    (number, address.map(|n| n.span))
}

pub(super) fn read(
    fields: &mut Fields<'_>,
    direction: Direction,
    (address, address_span): (Option<u8>, Option<sensedsl_diagnostics::Span>),
    frame: &Frame,
) -> Exchange {
    let duplex = fields.word("duplex", &DUPLEXES).map(|word| word.value).unwrap_or_default();
    let request = fields.addressed("request", 1..=24, address);
    let sums = fields.word("request_checksum", SUMS_BEHIND).map(|word| word.value);
    let request_end = fields.bytes("request_end", 0..=8).map(|bytes| bytes.value);
    let body = fields.integer("body", 1..=255);
    let sums_request = fields.boolean("sums_request").is_some_and(|word| word.value);
    let answer = fields.addressed("answer", 1..=16, address);
    let answer_sum = fields.word("answer_checksum", SUMS_BEHIND).map(|word| word.value);
    let behind = fields.addressed("behind", 0..=16, address);
    let wait = fields.time_ms("wait", 1..=1_000).map_or(WAIT_DEFAULT_MS, |time| time.value);
    let resend = fields.time_ms("resend", 1..=60_000);
    if request.is_some() && body.is_none() && !frame.has_end {
        fields.missing("body", "body = 4;");
    }
    for (one, name, of) in [
        (request.as_ref().map(|one| one.span), "request", Direction::Sensor),
        (resend.map(|one| one.span), "resend", Direction::Actuator),
    ] {
        if let Some(at) = one.filter(|_| direction != of && !fields.is_of_reading()) {
            fields.needs_direction(at, name, of);
        }
    }
    let is = |of: Direction| direction == of;
    let whole = |bytes: Option<Vec<u8>>, sum: Option<MessageChecksum>, end: &[u8]| {
        let mut all = bytes.unwrap_or_default();
        if !all.is_empty() {
            all.extend(sum.unwrap_or(frame.checksum).of(&all, frame.from));
            all.extend(end);
        }
        all
    };
    let asked = request.filter(|_| is(Direction::Sensor)).map(|one| one.value);
    let said = answer.filter(|_| is(Direction::Actuator)).map(|one| one.value);
    Exchange {
        address,
        address_span,
        duplex,
        request: whole(asked, sums, &request_end.unwrap_or_default()),
        body_bytes: body.and_then(|n| u16::try_from(n.value).ok()),
        sums_request,
        answer: whole(said, answer_sum, &[]),
        wait_ms: wait,
        behind: behind.map(|one| one.value).unwrap_or_default(),
        resend_ms: resend.filter(|_| is(Direction::Actuator)).map_or(0, |time| time.value),
    }
}

/// The address that a word in a list of bytes stands for.
pub(crate) fn is_address(value: &Value) -> bool {
    matches!(value, Value::Name(name) if name == ADDRESS)
}
