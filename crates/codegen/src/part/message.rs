//! A part on a serial port: `up_message_t` and what it points to.

use sensedsl_model::design::Device;
use sensedsl_model::kind::Kind;
use sensedsl_model::kind::uart::{MessageChecksum, Uart};
use sensedsl_model::protocol::{Format, TextField};
use sensedsl_model::words::Words;
use sensedsl_wire::Direction;

use super::bus::{self, InitPlan};
use super::{Source, ValuePlan, literal};
use crate::print::snake;

/// The longest message whose length nothing tells, with start and end: a line of NMEA 0183 has 82 characters, and
/// receivers with more digits send longer ones.
const OPEN_BYTES_MAX: u16 = 128;

/// An `up_message_t`.
#[derive(Clone, Debug)]
pub struct MessagePlan {
    /// What the names of its tables begin with.
    pub prefix: String,
    /// Written once to start the part.
    pub init: Vec<InitPlan>,
    /// First bytes of every message.
    pub start: Vec<String>,
    /// Last bytes of every message.
    pub end: Vec<String>,
    /// Bytes of the body; 0: as far as `end`.
    pub length: u16,
    /// Of the longest message.
    pub bytes_max: u16,
    /// The runtime's name for the checksum.
    pub checksum: &'static str,
    /// The first byte that is summed.
    pub checksum_from: u8,
    /// The values.
    pub fields: Vec<MessageFieldPlan>,
    /// The values that are sent.
    pub commands: Vec<ComposePlan>,
    /// 64-bit words that hold the largest value.
    pub scratch_words: usize,
}

/// An `up_compose_t`: a value that is sent as a message of its own.
#[derive(Clone, Debug)]
pub struct ComposePlan {
    /// The device.
    pub field: String,
    /// How the value is coded.
    pub value: ValuePlan,
    /// First bytes of the message.
    pub start: Vec<String>,
    /// Last bytes of the message.
    pub end: Vec<String>,
    /// The runtime's name for the checksum.
    pub checksum: &'static str,
    /// The first byte that is summed.
    pub checksum_from: u8,
    /// Of the whole message.
    pub bytes: u16,
}

/// An `up_message_field_t`.
#[derive(Clone, Debug)]
pub struct MessageFieldPlan {
    /// The device.
    pub field: String,
    /// What code calls it.
    pub ident: String,
    /// The runtime's name for how the number is written.
    pub format: &'static str,
    /// Where a binary value begins behind the start.
    pub byte: u16,
    /// How a binary value is coded; none for a text.
    pub value: Option<ValuePlan>,
    /// Only in a sentence of that type: a C string.
    pub sentence: Option<String>,
    /// Between fields; `0U` where the whole message is one.
    pub separator: String,
    /// Which field.
    pub index: u8,
    /// The value is the number times ten to that power.
    pub decimals: u8,
}

/// The part's table; none where nothing comes from it over a serial port.
pub(super) fn plan(source: Source<'_>, prefix: &str) -> Option<MessagePlan> {
    let all: Vec<&Device> = source.devices(|kind| matches!(kind, Kind::Uart(_))).collect();
    let is_sensor = |device: &&&Device| device.direction == Direction::Sensor;
    let devices: Vec<&Device> = all.iter().filter(is_sensor).copied().collect();
    let first = devices.first().or(all.first())?;
    let uart = source.design.main_connection(first)?.kind.uart()?;
    let is_text = devices.iter().any(|device| device.coding.text.is_some());
    let is_chip = source.part.chip.is_some();
    let is_open = !uart.end.is_empty() && !uart.is_length_given && (is_chip || is_text);
    let sizes = devices.iter().map(|device| device.value.value.size_bytes().div_ceil(8));
    Some(MessagePlan {
        prefix: prefix.to_owned(),
        init: bus::init(&source.protocol.init),
        start: literal::bytes(&uart.start),
        end: literal::bytes(&uart.end),
        length: if is_open { 0 } else { uart.length_bytes },
        bytes_max: if is_open { OPEN_BYTES_MAX } else { bytes(uart) },
        checksum: checksum(uart.checksum).0,
        checksum_from: uart.checksum_from,
        fields: devices.iter().filter_map(|device| field(device)).collect(),
        commands: all.iter().filter_map(|device| command(device)).collect(),
        scratch_words: sizes.max().unwrap_or(1),
    })
}

/// What the runtime calls a checksum, and how many bytes it has.
const fn checksum(checksum: MessageChecksum) -> (&'static str, u16) {
    match checksum {
        MessageChecksum::None => ("UP_CHECKSUM_NONE", 0),
        MessageChecksum::Sum8 => ("UP_CHECKSUM_SUM8", 1),
        MessageChecksum::Xor8 => ("UP_CHECKSUM_XOR8", 1),
        MessageChecksum::Ibus => ("UP_CHECKSUM_IBUS", 2),
        MessageChecksum::Crc8DvbS2 => ("UP_CHECKSUM_CRC8_DVB_S2", 1),
        MessageChecksum::Nmea => ("UP_CHECKSUM_NMEA", 3),
    }
}

/// Bytes of a message whose length is known.
fn bytes(uart: &Uart) -> u16 {
    let ends = u16::try_from(uart.start.len() + uart.end.len()).unwrap_or(u16::MAX);
    uart.length_bytes.saturating_add(ends).saturating_add(checksum(uart.checksum).1)
}

/// A value that is sent; none where it comes in.
fn command(device: &Device) -> Option<ComposePlan> {
    let Kind::Uart(uart) = &device.kind else { return None };
    let is_sent = device.direction == Direction::Actuator;
    let words = Words::of(device).filter(|_| is_sent)?;
    let ends = u16::try_from(uart.start.len() + uart.end.len()).unwrap_or(u16::MAX);
    let (checksum, checksum_bytes) = checksum(uart.checksum);
    Some(ComposePlan {
        field: device.name.value.clone(),
        value: ValuePlan::new(&words),
        start: literal::bytes(&uart.start),
        end: literal::bytes(&uart.end),
        checksum,
        checksum_from: uart.checksum_from,
        bytes: words.wire_bytes().saturating_add(ends).saturating_add(checksum_bytes),
    })
}

fn field(device: &Device) -> Option<MessageFieldPlan> {
    let name = device.name.value.clone();
    let Some(text) = &device.coding.text else {
        let value = ValuePlan::new(&Words::of(device)?);
        return Some(MessageFieldPlan {
            ident: snake(&name),
            field: name,
            format: "UP_FORMAT_BINARY",
            byte: device.coding.byte,
            value: Some(value),
            sentence: None,
            separator: "0U".to_owned(),
            index: 0,
            decimals: 0,
        });
    };
    let TextField { sentence, field, separator, format, decimals } = text;
    Some(MessageFieldPlan {
        ident: snake(&name),
        field: name,
        format: match format {
            Format::Decimal => "UP_FORMAT_DECIMAL",
            Format::Degrees => "UP_FORMAT_DEGREES",
            Format::Hex => "UP_FORMAT_HEX",
        },
        byte: 0,
        value: None,
        sentence: sentence.as_deref().map(literal::text),
        separator: literal::byte(&separator.unwrap_or(0)),
        index: *field,
        decimals: *decimals,
    })
}
