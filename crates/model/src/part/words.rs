//! Where a value is in the bytes of its part: from its coding and the number of its bytes to words
//! and bits, or the reason why it cannot be there. The reader of a file uses this to find mistakes;
//! generators of tables use it for the words.

use sensedsl_diagnostics::codes::e0239_outside_frame;
use sensedsl_diagnostics::{Diagnostic, Span};
use sensedsl_wire::{ScalarType, ValueType};

use crate::design::Device;
use crate::design::protocol::{Coding, Crc, Protocol};
use crate::kind::Kind;
use crate::kind::can::BitField;
use crate::kind::encoding::Encoding;
use crate::kind::i2c::ByteOrder;

/// How to read or write the bytes of a value; a word is an element.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Words {
    /// The format of a word.
    pub code: Code,
    /// Bytes of a word; 0 if words are packed.
    pub word_bytes: u8,
    /// The number of words.
    pub count: u16,
    /// The place of each element's word; empty if they are consecutive.
    pub elements: Vec<u8>,
    /// The lowest bit of the value.
    pub low: u8,
    /// The number of bits of the value.
    pub bits: u8,
    /// True if the highest of them is a sign.
    pub is_signed: bool,
    /// Whether the low byte of a word comes first.
    pub order: ByteOrder,
    /// Checksums between the words.
    pub crc: Option<Crc>,
    /// Bytes of all words, without the checksums.
    pub data_bytes: u16,
}

/// The format of a word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Code {
    /// A binary number.
    Integer,
    /// An IEEE 754 number.
    Float,
    /// Two decimal digits per byte.
    Bcd,
    /// A binary number whose highest bit is its sign.
    Magnitude,
    /// A binary number that follows the one before it without a gap.
    Packed,
    /// A colour, each bit of which is a pulse.
    Pulses,
    /// A colour in the frame of an LED with a clock.
    Leds,
    /// A letter as columns of dots.
    Text,
}

impl Words {
    /// The words of a device; none if its kind sends no bytes or its value is text.
    #[must_use]
    pub fn of(device: &Device) -> Option<Self> {
        let length = length_bytes(&device.kind, &device.coding)?;
        words(&device.kind, &device.coding, device.value.value, length).ok()
    }

    /// Bytes on the wire, including the checksums.
    #[must_use]
    pub const fn wire_bytes(&self) -> u16 {
        self.on_wire(self.data_bytes)
    }

    /// The bits that the value takes in a frame where it begins at that byte; byte 0 is the lowest.
    #[must_use]
    pub fn in_frame(&self, byte: u8) -> u64 {
        if self.code == Code::Packed || self.crc.is_some() {
            let bytes = self.wire_bytes();
            return (0..8 * bytes).fold(0, |all, bit| all | bit_of(u16::from(byte) + bit / 8, bit));
        }
        let words: Vec<u16> = if self.elements.is_empty() {
            (0..self.count).collect()
        } else {
            self.elements.iter().map(|word| u16::from(*word)).collect()
        };
        let word = |word: &u16| {
            let first = u16::from(byte) + word * u16::from(self.word_bytes);
            (0..self.bits).fold(0, |all, bit| all | self.bit(first, bit))
        };
        words.iter().map(word).fold(0, |all, one| all | one)
    }

    /// A number in the bits of its word, in a frame where the word begins at that byte; none if it
    /// has more bits than that.
    #[must_use]
    pub fn placed(&self, byte: u8, number: u64) -> Option<u64> {
        let is_held = self.bits >= 64 || number >> self.bits == 0;
        let set = |bit: &u8| number >> bit & 1 == 1;
        let all = (0..self.bits).filter(set).map(|bit| self.bit(byte.into(), bit));
        (is_held && self.count == 1).then(|| all.fold(0, |all, one| all | one))
    }

    /// A bit of a word that begins at that byte of a frame.
    fn bit(&self, first: u16, bit: u8) -> u64 {
        let bit = u16::from(self.low) + u16::from(bit);
        let behind = match self.order {
            ByteOrder::Little => bit / 8,
            ByteOrder::Big => u16::from(self.word_bytes).saturating_sub(1 + bit / 8),
        };
        bit_of(first + behind, bit)
    }

    /// The place of a byte of the words on the wire.
    #[must_use]
    pub const fn on_wire(&self, byte: u16) -> u16 {
        if self.crc.is_some() { byte + byte / 2 } else { byte }
    }
}

/// A bit of a byte of a frame whose byte 0 is the lowest; 0 beyond the end of the frame.
fn bit_of(byte: u16, bit: u16) -> u64 {
    1_u64.checked_shl(u32::from(8 * byte + bit % 8)).unwrap_or(0)
}

/// Checks that the value can be in its bytes, and that the formula gets the bytes that it takes.
pub(crate) fn check(
    kind: &Kind,
    coding: &Coding,
    value: ValueType,
    protocol: &Protocol,
) -> Result<(), String> {
    let Some(length) = length_bytes(kind, coding) else { return Ok(()) };
    if let Some(bytes) = kind.answer_bytes().map(|bytes| bytes - 1)
        && coding.byte.saturating_add(length) > bytes
    {
        let end = coding.byte.saturating_add(length);
        return Err(format!(
            "the part gives {bytes} bytes and their checksum, and the value ends at byte {end}"
        ));
    }
    // E0506 reports those.
    if kind.i2c().is_some() && coding.is_plain() {
        return Ok(());
    }
    if let (Some(formula), Some(_)) = (protocol.formula, coding.output) {
        let (_, raw, _) = formula.needs();
        let found = length;
        return if found == raw {
            Ok(())
        } else {
            Err(format!("{} is computed from {raw} bytes, and there are {found}", formula.name()))
        };
    }
    words(kind, coding, value, length).map(|_| ())
}

/// Reports a value that is received and ends after its message. `whole` is the connection, whose `length` is that of the
/// body.
pub(crate) fn outside(
    (at, name): (Span, &str),
    (kind, coding): (&Kind, &Coding),
    whole: &Kind,
) -> Option<Diagnostic> {
    let (uart, whole) = (kind.uart()?, whole.uart()?);
    let (property, body) = if uart.exchange.request.is_empty() {
        ("length", whole.is_length_given.then_some(whole.length_bytes)?)
    } else {
        ("body", uart.exchange.body_bytes?)
    };
    let (first, bytes) = (coding.byte, length_bytes(kind, coding)?);
    let report = e0239_outside_frame::outside_message;
    (first.saturating_add(bytes) > body).then(|| report(at, name, (first, bytes), (property, body)))
}

/// Bytes of the value; none if its kind sends no bytes or the value is text.
fn length_bytes(kind: &Kind, coding: &Coding) -> Option<u16> {
    if coding.text.is_some() {
        return None;
    }
    if !coding.exchange.is_empty() {
        return u16::try_from(coding.exchange.len()).ok();
    }
    let own = kind.bytes()?;
    own.length.or_else(|| coding.of.and_then(|of| u16::try_from(of.size_bytes()).ok()))
}

fn order(kind: &Kind) -> ByteOrder {
    kind.bytes().map(|own| own.order).unwrap_or_default()
}

fn words(kind: &Kind, coding: &Coding, value: ValueType, length: u16) -> Result<Words, String> {
    let of = coding.of.unwrap_or(value);
    if let Some(field) = kind.can().and_then(|can| can.field) {
        return in_frame(kind, coding, of.scalar, value.scalar, field);
    }
    let elements = u16::try_from(of.count()).unwrap_or(u16::MAX).max(1);
    if let Some(words) = encoded(kind, of, elements) {
        return Ok(words);
    }
    if let Some(bits) = coding.packed_bits {
        return packed(coding, of, (elements, bits), length);
    }
    let size = u16::try_from(of.scalar.size_bytes()).unwrap_or(8);
    let count = match coding.elements.iter().max() {
        Some(_) => length / size.max(1),
        None => elements,
    };
    let word_bytes = if coding.elements.is_empty() { length / count.max(1) } else { size };
    if word_bytes * count != length && coding.elements.is_empty() {
        return Err(format!("{length} bytes are not {elements} words of the same size"));
    }
    if let Some(last) = coding.elements.iter().max()
        && u16::from(*last) >= count
    {
        return Err(format!("`elements` names word {last}, and {length} bytes are {count} words"));
    }
    let is_word = (1..=8).contains(&word_bytes);
    let word_bytes = u8::try_from(word_bytes).ok().filter(|_| is_word).ok_or_else(|| {
        format!("a word has 1 to 8 bytes, and {length} bytes are {count} of {word_bytes}")
    })?;
    let width = 8 * word_bytes;
    let (high, low) = coding.bits.unwrap_or((width - 1, 0));
    if high >= width {
        return Err(format!("a word of {word_bytes} bytes has no bit {high}"));
    }
    let code = code(coding, of.scalar, value.scalar, word_bytes)?;
    if coding.crc.is_some() && length % 2 == 1 {
        return Err(format!("a checksum follows every two bytes, and there are {length}"));
    }
    Ok(Words {
        code,
        word_bytes,
        count,
        elements: coding.elements.clone(),
        low,
        bits: high - low + 1,
        is_signed: coding.signed.unwrap_or_else(|| is_signed(of.scalar)),
        order: order(kind),
        crc: coding.crc,
        data_bytes: length,
    })
}

/// The words of a value that its encoding sends otherwise: they are what is sent, not its bytes. `elements` are then
/// the colours in the order in which they are sent.
fn encoded(kind: &Kind, of: ValueType, count: u16) -> Option<Words> {
    let code = match kind.encoding() {
        Encoding::Plain => return None,
        Encoding::Ws2812 | Encoding::Sk6812 => Code::Pulses,
        Encoding::Apa102 => Code::Leds,
        Encoding::Text => Code::Text,
    };
    let word_bytes = u8::try_from(of.scalar.size_bytes()).unwrap_or(8);
    Some(Words {
        code,
        word_bytes,
        count,
        elements: kind.spi().map(|spi| spi.colours.to_vec()).unwrap_or_default(),
        low: 0,
        bits: 8 * word_bytes,
        is_signed: false,
        order: ByteOrder::Big,
        crc: None,
        data_bytes: u16::from(word_bytes).saturating_mul(count),
    })
}

/// The words of a value that is some bits of a frame.
fn in_frame(
    kind: &Kind,
    coding: &Coding,
    of: ScalarType,
    value: ScalarType,
    field: BitField,
) -> Result<Words, String> {
    if coding.crc.is_some() || coding.packed_bits.is_some() || !coding.elements.is_empty() {
        return Err("`bit` goes with none of `packed`, `elements` and `crc`".to_owned());
    }
    let BitField { word_bytes, low, bits } = field;
    let is_whole = usize::from(bits) == 8 * of.size_bytes() && bits == 8 * word_bytes;
    let code = if is_whole || coding.bcd || coding.is_magnitude {
        code(coding, of, value, word_bytes)?
    } else {
        Code::Integer
    };
    Ok(Words {
        code,
        word_bytes,
        count: 1,
        elements: Vec::new(),
        low,
        bits,
        is_signed: coding.signed.unwrap_or_else(|| is_signed(of)),
        order: order(kind),
        crc: None,
        data_bytes: word_bytes.into(),
    })
}

fn packed(
    coding: &Coding,
    of: ValueType,
    (count, bits): (u16, u8),
    length: u16,
) -> Result<Words, String> {
    let needed = (u32::from(count) * u32::from(bits)).div_ceil(8);
    if needed > u32::from(length) {
        return Err(format!("{count} numbers of {bits} bits are {needed} bytes, not {length}"));
    }
    if coding.crc.is_some() || coding.bcd || coding.is_magnitude || coding.bits.is_some() {
        return Err("`packed` goes with none of `bits`, `crc` and `format`".to_owned());
    }
    Ok(Words {
        code: Code::Packed,
        word_bytes: 0,
        count,
        elements: coding.elements.clone(),
        low: 0,
        bits,
        is_signed: coding.signed.unwrap_or_else(|| is_signed(of.scalar)),
        order: ByteOrder::Little,
        crc: None,
        data_bytes: length,
    })
}

fn code(
    coding: &Coding,
    of: ScalarType,
    value: ScalarType,
    word_bytes: u8,
) -> Result<Code, String> {
    if coding.bcd {
        return Ok(Code::Bcd);
    }
    if coding.is_magnitude {
        return Ok(Code::Magnitude);
    }
    // If there are fewer bytes than a float has, they are a whole number.
    let is_whole = usize::from(word_bytes) != of.size_bytes() || coding.bits.is_some();
    if !is_float(of) || is_whole {
        return Ok(Code::Integer);
    }
    if of != value {
        return Err(format!("the part has a {of}, so the device must be one"));
    }
    Ok(Code::Float)
}

const fn is_float(scalar: ScalarType) -> bool {
    matches!(scalar, ScalarType::Float32 | ScalarType::Float64)
}

/// Whether numbers of that type have a sign.
#[must_use]
pub fn is_signed(scalar: ScalarType) -> bool {
    scalar.integer_range().is_some_and(|(least, _)| least < 0)
}
