//! The coding of a value's bytes: `up_value_t`.

use sensedsl_model::design::Device;
use sensedsl_model::kind::i2c::ByteOrder;
use sensedsl_model::protocol::Crc;
use sensedsl_model::words::{Code, Words};

/// An `up_value_t`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ValuePlan {
    /// The word of each element; empty if the words are in the order of the elements. Of a strip, the place of each
    /// colour in its number.
    pub elements: Vec<u8>,
    /// The number of words if `elements` selects among them; otherwise 0. Of a strip, the number of colours.
    pub words: u16,
    /// The format of a word.
    pub code: Code,
    /// The checksums between the words.
    pub crc: Option<Crc>,
    /// The bytes of a word; 0 for packed words. Of pulses, the bits that are high for a 1.
    pub word_bytes: u8,
    /// The lowest significant bit. Of pulses, the bits that are high for a 0.
    pub low: u8,
    /// The number of significant bits; 0 for all. Of pulses, the bits of the bus for one of the strip.
    pub bits: u8,
    /// True if the highest of them is a sign.
    pub is_signed: bool,
    /// True if the low byte of a word comes first.
    pub is_little_endian: bool,
}

impl ValuePlan {
    /// The coding of a device whose bytes are the words.
    #[must_use]
    pub fn new(words: &Words) -> Self {
        let is_whole = words.low == 0 && u16::from(words.bits) == 8 * u16::from(words.word_bytes);
        let last = words.elements.iter().max().map_or(0, |last| u16::from(*last) + 1);
        Self {
            elements: words.elements.clone(),
            words: last,
            code: words.code,
            crc: words.crc,
            word_bytes: words.word_bytes,
            low: words.low,
            bits: if is_whole { 0 } else { words.bits },
            is_signed: words.is_signed && matches!(words.code, Code::Integer | Code::Packed),
            is_little_endian: words.order == ByteOrder::Little && words.code != Code::Packed,
        }
    }

    /// The coding of a value that is sent as text.
    pub(super) const fn none() -> Self {
        Self {
            elements: Vec::new(),
            words: 0,
            code: Code::Integer,
            crc: None,
            word_bytes: 1,
            low: 0,
            bits: 0,
            is_signed: false,
            is_little_endian: false,
        }
    }

    /// The coding of a device, as [`Self::new`] gives it; `None` if the device has no words.
    pub(super) fn of(device: &Device) -> Option<Self> {
        Words::of(device).as_ref().map(Self::new)
    }
}
