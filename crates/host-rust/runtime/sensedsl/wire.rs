//! What travels: checksums, schemas, and the frames that a host sends.

use core::fmt;

use super::message::AnyMessage;

pub(super) const HELLO: u8 = 0;
pub(super) const HEALTH: u8 = 255;
pub(super) const CHECKSUM: u8 = 255;
pub(super) const HEALTH_VERSION: u8 = 1;
pub(super) const STAMP_BYTES: usize = 6;
/// Bytes of health before the devices, and of each device.
pub(super) const HEALTH_BYTES: [usize; 2] = [19, 17];

/// The checksum at the end of payloads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Checksum {
    /// There is none.
    None,
    /// CRC-16/CCITT-FALSE.
    Crc16,
    /// CRC-32/ISO-HDLC.
    Crc32,
}

const fn crc16_table() -> [u16; 256] {
    let mut table = [0; 256];
    let mut byte = 0;
    while byte < 256 {
        let mut crc = (byte as u16) << 8;
        let mut bit = 0;
        while bit < 8 {
            crc = if crc & 0x8000 == 0 { crc << 1 } else { (crc << 1) ^ 0x1021 };
            bit += 1;
        }
        table[byte] = crc;
        byte += 1;
    }
    table
}

const fn crc32_table() -> [u32; 256] {
    let mut table = [0; 256];
    let mut byte = 0;
    while byte < 256 {
        let mut crc = byte as u32;
        let mut bit = 0;
        while bit < 8 {
            crc = if crc & 1 == 0 { crc >> 1 } else { (crc >> 1) ^ 0xEDB8_8320 };
            bit += 1;
        }
        table[byte] = crc;
        byte += 1;
    }
    table
}

static CRC16: [u16; 256] = crc16_table();
static CRC32: [u32; 256] = crc32_table();

impl Checksum {
    /// Bytes that it adds to each payload: its identifier and its number.
    #[must_use]
    pub const fn bytes(self) -> usize {
        match self {
            Self::None => 0,
            Self::Crc16 => 3,
            Self::Crc32 => 5,
        }
    }

    /// The number of a payload.
    #[must_use]
    pub fn of(self, payload: &[u8]) -> u32 {
        match self {
            Self::None => 0,
            Self::Crc16 => {
                let step = |crc: u16, byte: &u8| (crc << 8) ^ CRC16[usize::from((crc >> 8) as u8 ^ byte)];
                u32::from(payload.iter().fold(0xFFFF, step))
            }
            Self::Crc32 => {
                let step = |crc: u32, byte: &u8| (crc >> 8) ^ CRC32[usize::from(crc as u8 ^ byte)];
                !payload.iter().fold(u32::MAX, step)
            }
        }
    }

    /// Whether the bytes behind a payload are its checksum.
    pub(super) fn agrees(self, payload: &[u8], behind: &[u8]) -> bool {
        let [a, b, c, d] = self.of(payload).to_be_bytes();
        match (self, behind) {
            (Self::None, _) => true,
            (Self::Crc16, [CHECKSUM, rest @ ..]) => rest == [c, d],
            (Self::Crc32, [CHECKSUM, rest @ ..]) => rest == [a, b, c, d],
            (Self::Crc16 | Self::Crc32, _) => false,
        }
    }
}

/// A value on a link.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Item {
    /// The identifier.
    pub id: u8,
    /// The device's name.
    pub name: &'static str,
    /// Whether it travels from the board to the host.
    pub is_sensor: bool,
    /// Bytes of the value.
    pub bytes: u32,
    /// Whether each byte is 0 or 1.
    pub is_bool: bool,
}

/// What a decoder must know of an identifier: bytes of its value, 0 for none, and whether it is a `bool`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slot {
    pub(super) bytes: u32,
    pub(super) is_bool: bool,
}

/// The items of one direction, by identifier.
#[derive(Debug)]
pub struct Table {
    pub(super) slots: [Slot; 256],
    /// Bytes of the longest payload but health, without a checksum.
    pub(super) short_bytes: usize,
}

impl Table {
    /// The table of the items that travel in a direction.
    #[must_use]
    pub const fn new(items: &[Item], is_sensor: bool, is_stamped: bool) -> Self {
        let mut slots = [Slot { bytes: 0, is_bool: false }; 256];
        let (mut at, mut report) = (0, 0);
        while at < items.len() {
            let item = items[at];
            if item.is_sensor == is_sensor {
                slots[item.id as usize] = Slot { bytes: item.bytes, is_bool: item.is_bool };
                report += 1 + item.bytes as usize;
            }
            at += 1;
        }
        if is_sensor && is_stamped && report > 0 {
            report += STAMP_BYTES;
        }
        let least = if is_sensor { 5 } else { 2 };
        Self { slots, short_bytes: if report > least { report } else { least } }
    }

    /// Bytes of the longest frame from a board with such items.
    #[must_use]
    pub const fn frame_bytes(items: &[Item], is_stamped: bool, checksum: Checksum) -> usize {
        let short = Self::new(items, true, is_stamped).short_bytes;
        let health = HEALTH_BYTES[0] + HEALTH_BYTES[1] * items.len();
        let payload = if short > health { short } else { health } + checksum.bytes();
        payload + payload.ilog10() as usize + 3
    }
}

/// What a board's link carries; the type of each board has it.
pub trait Schema: Copy + fmt::Debug + Sized + 'static {
    /// Any message of the board.
    type Message: AnyMessage;
    /// Memory for the longest frame.
    type Held: AsRef<[u8]> + AsMut<[u8]> + Clone + fmt::Debug + Send;
    /// That memory, empty.
    const HELD: Self::Held;
    /// The board's name in the design.
    const NAME: &'static str;
    /// The text that the hash is made of.
    const TEXT: &'static str;
    /// The hash by which host and board know that they speak of the same devices.
    const HASH: u32;
    /// The checksum at the end of payloads.
    const CHECKSUM: Checksum;
    /// Whether reports begin with a stamp.
    const IS_STAMPED: bool;
    /// The rate of a serial link.
    const BAUD: u32;
    /// After how long without a frame from the host actuators take their failsafe.
    const SILENCE_MS: Option<u32>;
    /// All devices, in the design's order.
    const ITEMS: &'static [Item];
    /// What travels from the board to the host.
    const SENSORS: &'static Table;
    /// What travels from the host to the board.
    const ACTUATORS: &'static Table;
    /// The message of an item, if it has such bytes.
    fn read(id: u8, bytes: &[u8]) -> Option<Self::Message>;
}

/// When a board put a report together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stamp {
    /// Microseconds since the board started; wraps after 71.6 minutes.
    pub time_us: u32,
    /// Counts reports; wraps. A gap tells how many were lost.
    pub counter: u8,
}

/// Why messages do not make a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EncodeError {
    /// There is no message.
    Empty,
    /// A message is of a sensor, where actuators are set.
    Direction(&'static str),
    /// There are two messages of one device.
    Twice(&'static str),
    /// The frame is longer than the memory for it.
    Room,
}

impl fmt::Display for EncodeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty => f.write_str("a frame needs a message"),
            Self::Direction(name) => write!(f, "{name} travels the other way"),
            Self::Twice(name) => write!(f, "{name} is there twice"),
            Self::Room => f.write_str("the frame is longer than the memory for it"),
        }
    }
}

impl core::error::Error for EncodeError {}

/// Writes bytes one after the other.
struct Writer<'b> {
    bytes: &'b mut [u8],
    length: usize,
}

impl Writer<'_> {
    fn put(&mut self, bytes: &[u8]) -> Result<(), EncodeError> {
        let end = self.length + bytes.len();
        let place = self.bytes.get_mut(self.length..end).ok_or(EncodeError::Room)?;
        place.copy_from_slice(bytes);
        self.length = end;
        Ok(())
    }
}

/// A frame of a payload that `fill` writes; its bytes are known before.
fn frame(
    checksum: Checksum,
    payload_bytes: usize,
    bytes: &mut [u8],
    fill: impl FnOnce(&mut Writer<'_>) -> Result<(), EncodeError>,
) -> Result<&[u8], EncodeError> {
    let mut digits = [0; 10];
    let (mut at, mut rest) = (digits.len(), payload_bytes + checksum.bytes());
    while let (true, Some(place)) = (rest > 0, digits.get_mut(at - 1)) {
        *place = b'0' + (rest % 10) as u8;
        (at, rest) = (at - 1, rest / 10);
    }
    let mut writer = Writer { bytes, length: 0 };
    writer.put(digits.get(at..).unwrap_or_default())?;
    writer.put(b":")?;
    let start = writer.length;
    fill(&mut writer)?;
    let number = checksum.of(writer.bytes.get(start..writer.length).unwrap_or_default()).to_be_bytes();
    if checksum != Checksum::None {
        writer.put(&[CHECKSUM])?;
        writer.put(number.get(5 - checksum.bytes()..).unwrap_or_default())?;
    }
    writer.put(b",")?;
    let Writer { bytes, length } = writer;
    Ok(bytes.get(..length).unwrap_or_default())
}

fn encode_items<'b, S: Schema>(
    is_sensor: bool,
    stamp: Option<Stamp>,
    messages: &[S::Message],
    bytes: &'b mut [u8],
) -> Result<&'b [u8], EncodeError> {
    if messages.is_empty() {
        return Err(EncodeError::Empty);
    }
    for (index, message) in messages.iter().enumerate() {
        let facts = message.facts();
        if facts.is_sensor != is_sensor {
            return Err(EncodeError::Direction(facts.name));
        }
        if messages.iter().take(index).any(|earlier| earlier.facts().id == facts.id) {
            return Err(EncodeError::Twice(facts.name));
        }
    }
    let values: usize = messages.iter().map(|message| 1 + message.bytes()).sum();
    let payload = values + if stamp.is_some() { STAMP_BYTES } else { 0 };
    frame(S::CHECKSUM, payload, bytes, |writer| {
        if let Some(Stamp { time_us, counter }) = stamp {
            writer.put(&[HELLO])?;
            writer.put(&time_us.to_be_bytes())?;
            writer.put(&[counter])?;
        }
        for item in S::ITEMS {
            let Some(message) = messages.iter().find(|message| message.facts().id == item.id) else { continue };
            writer.put(&[item.id])?;
            let end = writer.length + message.bytes();
            message.write(writer.bytes.get_mut(writer.length..end).ok_or(EncodeError::Room)?);
            writer.length = end;
        }
        Ok(())
    })
}

/// The frame that sets actuators, in memory of the caller's.
///
/// # Errors
/// Fails if there is no message, one of a sensor, two of one actuator, or too little memory.
pub fn encode<'b, S: Schema>(messages: &[S::Message], bytes: &'b mut [u8]) -> Result<&'b [u8], EncodeError> {
    encode_items::<S>(false, None, messages, bytes)
}

/// What a board sends of its sensors, for tests of programs.
///
/// # Errors
/// Fails as [`encode`] does.
pub fn encode_report<'b, S: Schema>(
    stamp: Stamp,
    messages: &[S::Message],
    bytes: &'b mut [u8],
) -> Result<&'b [u8], EncodeError> {
    encode_items::<S>(true, S::IS_STAMPED.then_some(stamp), messages, bytes)
}

/// What a board says when it is asked who it is, for tests of programs.
///
/// # Errors
/// Fails if there is too little memory.
pub fn encode_hello<S: Schema>(bytes: &mut [u8]) -> Result<&[u8], EncodeError> {
    frame(S::CHECKSUM, 5, bytes, |writer| {
        writer.put(&[HELLO])?;
        writer.put(&S::HASH.to_be_bytes())
    })
}

/// A question to a board.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Question {
    bytes: [u8; 12],
    length: usize,
}

impl AsRef<[u8]> for Question {
    fn as_ref(&self) -> &[u8] {
        self.bytes.get(..self.length).unwrap_or_default()
    }
}

/// The question who the board is or, with `health`, how it is.
#[must_use]
pub fn question(checksum: Checksum, health: bool) -> Question {
    let payload: &[u8] = if health { &[HELLO, 1] } else { &[HELLO] };
    let mut bytes = [0; 12];
    // Ten bytes at most.
    let length = frame(checksum, payload.len(), &mut bytes, |writer| writer.put(payload)).map_or(0, <[u8]>::len);
    Question { bytes, length }
}
