//! `uart`: bytes on a serial port, cut into messages by delimiters or by length. A sensor with
//! `tx = none` takes only the receiving wire. What is asked and told is in `uart/exchange.rs`.

mod checksum;
pub(crate) mod exchange;

pub use checksum::MessageChecksum;
pub(crate) use checksum::{CHECKSUMS, SUMS_BEHIND};
pub use exchange::{Duplex, Exchange};

use super::i2c::{self, ByteOrder, ORDERS};
use super::role::Role;
use super::spec::{KindSpec, Properties, Serves, Sharing, Values};
use crate::fields::Fields;
use crate::meaning::{Meaning, Takes, first};
use sensedsl_board::signal::{Function, UartLine};
use sensedsl_wire::{Direction, ScalarType, ValueType};

/// The properties that all devices of this kind share.
pub const SPEC: KindSpec = KindSpec {
    name: "uart",
    article: "a",
    directions: &[Direction::Sensor, Direction::Actuator],
    values: Values::Any,
    properties: &[
        "baud",
        "frame",
        "invert",
        "start",
        "end",
        "length",
        "checksum",
        "checksum_from",
        "order",
        "address",
        "duplex",
        "request",
        "request_checksum",
        "request_end",
        "body",
        "sums_request",
        "answer",
        "answer_checksum",
        "behind",
        "wait",
        "resend",
        "tx",
        "rx",
        "direction",
    ],
    sharing: Sharing::Own,
    triggers_itself: false,
    codes: None,
    natural: ScalarType::Uint16,
    inputs_have: &[],
    of_part: &["length"],
    serves: Serves::Signal(serves),
    wires: "TX and RX of one unit; RX alone for a sensor with `tx = none;`; TX alone with `duplex = half;`. Shared by parts with different `address`es",
    example: "",
    colour: "#DF8AB6",
    colour_on_dark: "#C07AA5",
    letter: 'U',
};

/// What its properties mean, besides those that fix wires.
pub(crate) const MEANINGS: &[Meaning] = &[
    Meaning::new(
        ("baud", Takes::Whole(300, 10_000_000)),
        "9600",
        "Bits per second.",
        "baud = 115200;",
    ),
    Meaning::new(
        ("frame", Takes::Words(|| first(&FRAMES))),
        "`\"8N1\"`",
        "Data bits, parity and stop bits.",
        "frame = \"8E1\";",
    ),
    Meaning::new(
        ("invert", Takes::Truth),
        "`false`",
        "The wires are low at rest (SBUS).",
        "invert = true;",
    ),
    Meaning::new(
        ("start", Takes::Bytes(0, 16)),
        "none",
        "What a message begins with.",
        "start = \"$GP\";",
    ),
    Meaning::new(
        ("end", Takes::Bytes(0, 8)),
        "none",
        "What a message ends with.",
        "end = \"\\r\\n\";",
    ),
    Meaning::new(
        ("length", Takes::Whole(1, 1_024)),
        "the size of the type; with `end` in a driver with readings: up to there",
        "Bytes of a message between `start` and `end`, without the checksum.",
        "length = 8;",
    ),
    Meaning::new(
        ("checksum", Takes::Words(|| first(&CHECKSUMS))),
        "`none`",
        "What stands before `end`. `sum8`, `sum7`: low byte, or low seven bits, of the sum; `not_sum8`: all its bits \
         inverted; `neg_sum8`, `neg_sum16`: what makes the sum 0 in one byte, or in two, high one first; `xor8`: all \
         bytes exclusive or; `ibus`: 0xFFFF minus the sum, two bytes, low one first; `sum16`: the sum, two bytes, high one first; `crc8_dvb_s2`, `crc8_ld06`: CRC-8 of polynomial 0xD5 or \
         0x4D; `crc16_umts`: CRC-16 of polynomial 0x8005, low byte first; `crc16_xmodem`: CRC-16 of polynomial 0x1021, \
         high byte first; `nmea`: `*` and two hexadecimal digits. `slamtec` stands before, in the first two bytes of the \
         body: 0xA and the low half, 0x5 and the high half of the exclusive or of all other bytes.",
        "checksum = xor8;",
    ),
    Meaning::new(
        ("checksum_from", Takes::Whole(0, 16)),
        "0",
        "The first byte that the checksum is of, counted from the first of `start`; the length of `start` at \
         most.",
        "checksum_from = 2;",
    ),
    Meaning::new(
        ("order", Takes::Words(|| first(&ORDERS))),
        "`big`",
        "The order of the bytes of each element: the highest or the lowest one first.",
        "order = little;",
    ),
    exchange::MEANINGS[0],
    exchange::MEANINGS[1],
    exchange::MEANINGS[2],
    exchange::MEANINGS[3],
    exchange::MEANINGS[4],
    exchange::MEANINGS[5],
    exchange::MEANINGS[6],
    exchange::MEANINGS[7],
    exchange::MEANINGS[8],
    exchange::MEANINGS[9],
    Meaning::new(
        ("wait", Takes::Time(1_000, 1_000_000)),
        "10 ms",
        "How long a part has for its answer. One that stays silent is a fault, and is asked again in the next cycle.",
        "wait = 5 ms;",
    ),
    Meaning::new(
        ("resend", Takes::Time(1_000, 60_000_000)),
        "never",
        "The command is sent again and again after it was set.",
        "resend = 100 ms;",
    )
    .only(Direction::Actuator),
];

/// Bits per second if the file gives none.
pub const BAUD_DEFAULT: u32 = 9_600;

/// Parity of a character.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Parity {
    /// `N`
    #[default]
    None,
    /// `E`
    Even,
    /// `O`
    Odd,
}

/// A serial port.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Uart {
    /// Bits per second.
    pub baud: u32,
    /// Where the baud rate is given.
    pub baud_span: Option<sensedsl_diagnostics::Span>,
    /// Data bits per character: 7 or 8.
    pub data_bits: u8,
    /// Parity of each character.
    pub parity: Parity,
    /// Stop bits: 1 or 2.
    pub stop_bits: u8,
    /// True if its wires idle low.
    pub is_inverted: bool,
    /// Bytes that a message begins with; may be empty.
    pub start: Vec<u8>,
    /// Bytes that a message ends with; may be empty.
    pub end: Vec<u8>,
    /// Bytes of a message between the delimiters.
    pub length_bytes: u16,
    /// True if the file gives that length; otherwise it is the size of the value.
    pub is_length_given: bool,
    /// The checksum that a message ends with.
    pub checksum: MessageChecksum,
    /// The first byte that the checksum covers, counted from the first byte of the message.
    pub checksum_from: u8,
    /// Order of the bytes of each number.
    pub order: ByteOrder,
    /// True if nothing is sent and the device needs only RX.
    pub receive_only: bool,
    /// What the part is asked or told.
    pub exchange: Exchange,
}

fn serves(role: Role, function: &Function) -> bool {
    let Function::Uart { line, .. } = function else { return false };
    match line {
        UartLine::Tx => role == Role::Tx,
        UartLine::Rx => role == Role::Rx,
    }
}

/// The words after `frame`: data bits, parity, stop bits.
const FRAMES: [(&str, (u8, Parity, u8)); 8] = [
    ("8N1", (8, Parity::None, 1)),
    ("8N2", (8, Parity::None, 2)),
    ("8E1", (8, Parity::Even, 1)),
    ("8E2", (8, Parity::Even, 2)),
    ("8O1", (8, Parity::Odd, 1)),
    ("8O2", (8, Parity::Odd, 2)),
    ("7E1", (7, Parity::Even, 1)),
    ("7O1", (7, Parity::Odd, 1)),
];

impl Properties for Uart {
    fn read(fields: &mut Fields<'_>, direction: Direction, value: ValueType) -> Self {
        let rate = fields.integer("baud", 300..=10_000_000);
        let baud = rate.and_then(|n| u32::try_from(n.value).ok());
        let frame = fields.word("frame", &FRAMES).map(|word| word.value);
        let (data_bits, parity, stop_bits) = frame.unwrap_or((8, Parity::None, 1));
        let address = exchange::address(fields);
        let start = fields.addressed("start", 0..=16, address.0);
        let start = start.map(|bytes| bytes.value).unwrap_or_default();
        let end = fields.bytes("end", 0..=8).map(|bytes| bytes.value).unwrap_or_default();
        let size_bytes = i64::try_from(value.size_bytes()).unwrap_or(i64::MAX);
        let length = fields.integer("length", 1..=1024).map(|n| n.value);
        let is_inverted = fields.boolean("invert").is_some_and(|word| word.value);
        let (checksum, checksum_from) = checksum(fields, start.len());
        let frame =
            exchange::Frame { has_end: !end.is_empty(), checksum, from: checksum_from.into() };
        let exchange = exchange::read(fields, direction, address, &frame);
        if checksum == MessageChecksum::Slamtec {
            check_slamtec(fields, length, direction);
        }
        let is_sensor = direction == Direction::Sensor;
        let receive_only = is_sensor && fields.take_word_if("tx", "none");
        Self {
            baud: baud.unwrap_or(BAUD_DEFAULT),
            baud_span: rate.map(|rate| rate.span),
            data_bits,
            parity,
            stop_bits,
            is_inverted,
            start,
            end,
            length_bytes: u16::try_from(length.unwrap_or(size_bytes)).unwrap_or(u16::MAX),
            is_length_given: length.is_some(),
            checksum,
            checksum_from,
            order: i2c::order(fields, value.scalar.size_bytes() == 1),
            receive_only,
            exchange,
        }
    }

    fn plain(_: u8) -> Self {
        Self::link(BAUD_DEFAULT)
    }

    fn roles(&self, _: Direction) -> Vec<Role> {
        match self.exchange.duplex {
            Duplex::Half => vec![Role::Tx],
            Duplex::Direction => vec![Role::Tx, Role::Rx, Role::Direction],
            Duplex::Full | Duplex::Joined if self.receive_only => vec![Role::Rx],
            Duplex::Full | Duplex::Joined => vec![Role::Tx, Role::Rx],
        }
    }
}

/// The checksum of a message, and the byte that it starts from.
fn checksum(fields: &mut Fields<'_>, start_bytes: usize) -> (MessageChecksum, u8) {
    let checksum = fields.word("checksum", &CHECKSUMS).map(|word| word.value).unwrap_or_default();
    // The bytes that it covers begin within the start bytes, or right after them.
    // Where each reading and command has a `start` of its own, it is read with them.
    let most = if start_bytes == 0 { 16 } else { i64::try_from(start_bytes).unwrap_or(16) };
    let from = fields.integer("checksum_from", 0..=most);
    if let Some(from) = from
        && !checksum.has_from()
    {
        let why = "`checksum_from` is not for `none`, `nmea` and `slamtec`";
        fields.contradiction(from.span, "checksum", why);
    }
    (checksum, from.and_then(|n| u8::try_from(n.value).ok()).unwrap_or(0))
}

/// Reports what a message cannot have whose first two bytes are its marks and its checksum.
fn check_slamtec(fields: &mut Fields<'_>, length: Option<i64>, direction: Direction) {
    let Some(at) = fields.value_span("checksum") else { return };
    let message = "`slamtec` is for messages that a part sends by itself, with neither `start` nor `end`: their first \
                   two bytes are marks and checksum";
    for other in ["start", "end", "request", "answer"] {
        if fields.value_span(other).is_some() {
            fields.contradiction(at, other, message);
        }
    }
    if fields.is_of_reading() {
        if direction == Direction::Actuator {
            fields.needs_direction(at, "checksum = slamtec", Direction::Sensor);
        }
    } else if length.is_none() {
        fields.missing("length", "length = 84;");
    }
}

impl Uart {
    /// Whether nothing marks the end of a message.
    #[must_use]
    pub fn is_endless(&self) -> bool {
        !self.is_length_given && self.end.is_empty()
    }

    /// A number that is the same for parts that can share a line: rate, characters, level at rest, wires.
    #[must_use]
    pub fn line(&self) -> u32 {
        let parity = match self.parity {
            Parity::None => 0,
            Parity::Even => 1,
            Parity::Odd => 2,
        };
        let characters =
            (u32::from(self.data_bits == 7) * 3 + parity) * 2 + u32::from(self.stop_bits == 2);
        let of_wires = self.exchange.duplex.number() * 2 + u32::from(self.is_inverted);
        // A rate has 24 bits, and the rest are fewer than 128.
        self.baud | (characters * 8 + of_wires) << 24
    }

    /// The serial port of a link: 8N1, both ways.
    #[must_use]
    pub fn link(baud: u32) -> Self {
        Self {
            baud,
            baud_span: None,
            data_bits: 8,
            parity: Parity::None,
            stop_bits: 1,
            is_inverted: false,
            start: Vec::new(),
            end: Vec::new(),
            length_bytes: 1,
            is_length_given: false,
            checksum: MessageChecksum::None,
            checksum_from: 0,
            order: ByteOrder::Big,
            receive_only: false,
            exchange: Exchange::default(),
        }
    }
}
