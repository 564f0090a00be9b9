//! How the bytes of a value are coded: `up_value_t`.

use sensedsl_model::design::Device;
use sensedsl_model::kind::i2c::ByteOrder;
use sensedsl_model::protocol::Crc;
use sensedsl_model::words::{Code, Words};

/// An `up_value_t`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ValuePlan {
    /// For each element where its word stands; empty for one after the other.
    pub elements: Vec<u8>,
    /// Words there are, where `elements` says which of them; otherwise 0.
    pub words: u16,
    /// What a word is.
    pub code: Code,
    /// Checksums between the words.
    pub crc: Option<Crc>,
    /// Bytes of a word; 0 where words are packed.
    pub word_bytes: u8,
    /// The lowest bit that counts.
    pub low: u8,
    /// Bits that count; 0 for all.
    pub bits: u8,
    /// The highest of them is a sign.
    pub is_signed: bool,
    /// The low byte of a word comes first.
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
            is_signed: words.is_signed && words.code != Code::Float && words.code != Code::Bcd,
            is_little_endian: words.order == ByteOrder::Little && words.code != Code::Packed,
        }
    }

    /// See [`Self::new`]; none where the device has no words.
    pub(super) fn of(device: &Device) -> Option<Self> {
        Words::of(device).as_ref().map(Self::new)
    }
}
