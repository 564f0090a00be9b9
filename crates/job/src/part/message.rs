//! A part on a serial port: `up_message_t` and the tables that it points to.

use sensedsl_model::design::Device;
use sensedsl_model::kind::uart::{MessageChecksum, Uart};
use sensedsl_model::protocol::{InitStep, TextField};
use sensedsl_model::words::Words;
use sensedsl_wire::Direction;

use super::bus::{self, InitPlan};
use super::source::Source;
use super::value::ValuePlan;
use crate::snake;

/// The longest message with start and end if its length is not given: a line of NMEA 0183 has 82 characters, and
/// receivers with more digits send longer ones.
const OPEN_BYTES_MAX: u16 = 128;

/// An `up_message_t`.
#[derive(Clone, Debug)]
pub struct MessagePlan {
    /// The prefix of the names of its tables.
    pub prefix: String,
    /// The bytes written once to start the part.
    pub init: Vec<InitPlan>,
    /// The first bytes of every message.
    pub start: Vec<u8>,
    /// The last bytes of every message.
    pub end: Vec<u8>,
    /// The bytes of the body; 0: up to `end`.
    pub length: u16,
    /// The bytes of the longest message.
    pub bytes_max: u16,
    /// The checksum before the end.
    pub checksum: MessageChecksum,
    /// The first byte that the checksum covers.
    pub checksum_from: u8,
    /// The values.
    pub fields: Vec<MessageFieldPlan>,
    /// The values that are sent.
    pub commands: Vec<ComposePlan>,
    /// The requests, each with the values in its answer.
    pub exchanges: Vec<ExchangePlan>,
    /// The number of 64-bit words that hold the largest value.
    pub scratch_words: usize,
}

/// An `up_compose_t`: a value that is sent as a message of its own.
#[derive(Clone, Debug)]
pub struct ComposePlan {
    /// The device's name.
    pub field: String,
    /// The coding of the value; of no meaning for a text.
    pub value: ValuePlan,
    /// The format of a value that is sent as a text.
    pub text: Option<TextField>,
    /// The first bytes of the message.
    pub start: Vec<u8>,
    /// The bytes between the value and the checksum.
    pub behind: Vec<u8>,
    /// The last bytes of the message.
    pub end: Vec<u8>,
    /// The checksum before the end.
    pub checksum: MessageChecksum,
    /// The first byte that the checksum covers.
    pub checksum_from: u8,
    /// The bytes of the whole message; of a text at most.
    pub bytes: u16,
    /// What the part says when it has taken it; empty if nothing is awaited.
    pub answer: Vec<u8>,
    /// The time that the part has for that.
    pub wait_ms: u16,
    /// The time after which it is sent again; 0 for never.
    pub resend_ms: u32,
}

/// An `up_exchange_t`: a request, and the message that answers it.
#[derive(Clone, Debug)]
pub struct ExchangePlan {
    /// The prefix of the names of its tables.
    pub prefix: String,
    /// What is sent.
    pub request: Vec<u8>,
    /// The first bytes of the answer.
    pub start: Vec<u8>,
    /// The last bytes of the answer.
    pub end: Vec<u8>,
    /// The bytes of the body; 0: up to `end`.
    pub length: u16,
    /// The bytes of the longest answer.
    pub bytes_max: u16,
    /// The checksum before the end.
    pub checksum: MessageChecksum,
    /// The first byte that the checksum covers.
    pub checksum_from: u8,
    /// The values.
    pub fields: Vec<MessageFieldPlan>,
    /// Whether the answer's checksum begins with the request.
    pub is_primed: bool,
    /// The time that the part has for the answer.
    pub wait_ms: u16,
}

impl MessagePlan {
    /// The bytes of the longest answer; 0 if nothing is asked.
    #[must_use]
    pub fn answer_bytes_max(&self) -> u16 {
        self.exchanges.iter().map(|one| one.bytes_max).max().unwrap_or(0)
    }
}

/// A number in a text: a sign, twenty digits, a point, and what separates it from the next.
const TEXT_BYTES: u16 = 23;

/// An `up_message_field_t`.
#[derive(Clone, Debug)]
pub struct MessageFieldPlan {
    /// The device's name.
    pub field: String,
    /// The device's identifier in code.
    pub ident: String,
    /// The place in the message and the format.
    pub how: FieldCoding,
}

/// The format of a number in a message.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FieldCoding {
    /// As bytes.
    Binary {
        /// The offset of the first byte after the start.
        byte: u16,
        /// The coding.
        value: ValuePlan,
    },
    /// As text.
    Text(TextField),
}

impl FieldCoding {
    /// The coding as bytes; `None` for text.
    #[must_use]
    pub const fn value(&self) -> Option<&ValuePlan> {
        match self {
            Self::Binary { value, .. } => Some(value),
            Self::Text(_) => None,
        }
    }

    /// The type of the only sentence that has it; `None` if any message has it.
    #[must_use]
    pub fn sentence(&self) -> Option<&str> {
        match self {
            Self::Binary { .. } => None,
            Self::Text(text) => text.sentence.as_deref(),
        }
    }
}

/// The part's table; `None` if nothing is received from it over a serial port.
pub(super) fn plan(source: Source<'_>, prefix: &str) -> Option<MessagePlan> {
    let all: Vec<&Device> = source.devices(|kind| kind.uart().is_some()).collect();
    let is_sensor = |device: &&&Device| device.direction == Direction::Sensor;
    let (asked, devices): (Vec<&Device>, Vec<&Device>) =
        all.iter().filter(is_sensor).copied().partition(|device| is_asked(device));
    let first = devices.first().or(all.first())?;
    let uart = source.design.main_connection(first)?.kind.uart()?;
    let is_text = devices.iter().any(|device| device.coding.text.is_some());
    let is_chip = source.part.chip.is_some();
    let is_open = !uart.end.is_empty() && !uart.is_length_given && (is_chip || is_text);
    let sizes = all.iter().filter(is_sensor);
    let sizes = sizes.map(|device| device.value.value.size_bytes().div_ceil(8));
    Some(MessagePlan {
        prefix: prefix.to_owned(),
        init: init(&source.protocol.init, uart.baud),
        start: uart.start.clone(),
        end: uart.end.clone(),
        length: if is_open { 0 } else { uart.length_bytes },
        bytes_max: if is_open { OPEN_BYTES_MAX } else { bytes(uart) },
        checksum: uart.checksum,
        checksum_from: uart.checksum_from,
        fields: devices.iter().filter_map(|device| field(device)).collect(),
        commands: all.iter().filter_map(|device| command(device)).collect(),
        exchanges: exchanges(&asked, prefix),
        scratch_words: sizes.max().unwrap_or(1),
    })
}

fn is_asked(device: &Device) -> bool {
    device.kind.uart().is_some_and(|uart| !uart.exchange.request.is_empty())
}

/// The requests, in the order of the devices; values of one answer go together.
fn exchanges(asked: &[&Device], prefix: &str) -> Vec<ExchangePlan> {
    let mut all: Vec<ExchangePlan> = Vec::new();
    for device in asked {
        let Some(uart) = device.kind.uart() else { continue };
        let Some(field) = field(device) else { continue };
        let mut own = exchange(uart, format!("{prefix}_answer_{}", all.len()));
        let same = |one: &&mut ExchangePlan| {
            (&one.request, &one.start, &one.end, one.length)
                == (&own.request, &own.start, &own.end, own.length)
        };
        match all.iter_mut().find(same) {
            Some(one) => one.fields.push(field),
            None => {
                own.fields.push(field);
                all.push(own);
            }
        }
    }
    all
}

fn exchange(uart: &Uart, prefix: String) -> ExchangePlan {
    let asked = &uart.exchange;
    let start = if asked.sums_request { &asked.request } else { &uart.start };
    let around = start.len() + uart.end.len();
    let around =
        u16::try_from(around).unwrap_or(u16::MAX).saturating_add(checksum_bytes(uart.checksum));
    let length = asked.body_bytes.unwrap_or(0);
    ExchangePlan {
        prefix,
        request: asked.request.clone(),
        start: start.clone(),
        end: uart.end.clone(),
        length,
        bytes_max: if length == 0 { OPEN_BYTES_MAX } else { length.saturating_add(around) },
        checksum: uart.checksum,
        checksum_from: uart.checksum_from,
        fields: Vec::new(),
        is_primed: asked.sums_request,
        wait_ms: u16::try_from(asked.wait_ms).unwrap_or(u16::MAX),
    }
}

/// The steps that set up the part. Bytes are queued and sent later, so each pause is extended by the time that the
/// bytes before it take on the line, at up to twelve bits a character.
fn init(steps: &[InitStep], baud: u32) -> Vec<InitPlan> {
    let mut all = bus::init(steps);
    let mut characters = 0;
    for step in &mut all {
        characters += step.bytes.len() as u64;
        if step.pause_ms > 0 {
            let line_ms = (characters * 12_000).div_ceil(u64::from(baud.max(1)));
            step.pause_ms =
                step.pause_ms.saturating_add(u16::try_from(line_ms).unwrap_or(u16::MAX));
            characters = 0;
        }
    }
    all
}

/// The bytes of a checksum.
const fn checksum_bytes(checksum: MessageChecksum) -> u16 {
    checksum.bytes()
}

/// The bytes of a message of known length.
fn bytes(uart: &Uart) -> u16 {
    let ends = u16::try_from(uart.start.len() + uart.end.len()).unwrap_or(u16::MAX);
    uart.length_bytes.saturating_add(ends).saturating_add(checksum_bytes(uart.checksum))
}

/// The message that sends a value; `None` if the value is received.
fn command(device: &Device) -> Option<ComposePlan> {
    let uart = device.kind.uart().filter(|_| device.direction == Direction::Actuator)?;
    let text = device.coding.text.clone();
    let count = u16::try_from(device.value.value.count()).unwrap_or(u16::MAX);
    let (value, value_bytes) = match &text {
        Some(_) => (ValuePlan::none(), TEXT_BYTES.saturating_mul(count)),
        None => {
            let words = Words::of(device)?;
            (ValuePlan::new(&words), words.wire_bytes())
        }
    };
    let told = &uart.exchange;
    let ends = u16::try_from(uart.start.len() + told.behind.len() + uart.end.len());
    Some(ComposePlan {
        field: device.name.value.clone(),
        value,
        text,
        start: uart.start.clone(),
        behind: told.behind.clone(),
        end: uart.end.clone(),
        checksum: uart.checksum,
        checksum_from: uart.checksum_from,
        bytes: value_bytes
            .saturating_add(ends.unwrap_or(u16::MAX))
            .saturating_add(checksum_bytes(uart.checksum)),
        answer: told.answer.clone(),
        wait_ms: u16::try_from(told.wait_ms).unwrap_or(u16::MAX),
        resend_ms: told.resend_ms,
    })
}

fn field(device: &Device) -> Option<MessageFieldPlan> {
    let how = match &device.coding.text {
        Some(text) => FieldCoding::Text(text.clone()),
        None => {
            let value = ValuePlan::new(&Words::of(device)?);
            FieldCoding::Binary { byte: device.coding.byte, value }
        }
    };
    let field = device.name.value.clone();
    Some(MessageFieldPlan { ident: snake(&field), field, how })
}
