//! From the bytes of a device to the value of an item, and back: words, bit fields, byte order,
//! packed bits, BCD, signs with magnitudes, checksums.
//!
//! Integers saturate to the item's type instead of wrapping; bool is "not zero".

use crate::bytes::at;
use crate::checksum::crc8;
use crate::convert::{load_magnitude, store_signed, store_unsigned};
use crate::lamps;
use crate::letters;
use crate::outcome::Outcome;
use crate::scalar::Scalar;
use crate::schema::Item;
use crate::uses;

const SENSIRION_POLYNOMIAL: u8 = 0x31;
const SENSIRION_START: u8 = 0xFF;
const PACKED_BITS_MAX: u32 = 32;

/// The format of a word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Code {
    /// A binary number.
    Integer,
    /// An IEEE 754 number: 4 bytes for a float32, 8 for a float64.
    Float,
    /// Two decimal digits per byte.
    Bcd,
    /// A binary number whose highest bit is its sign.
    Magnitude,
    /// `bits` bits per word, without gaps between words, least significant bit first.
    Packed,
    /// Commands only: colours of a strip with one wire. `elements` are the places of a colour's
    /// bytes in the order in which they are sent (0 for the lowest), and `words` is their number.
    /// Each of their bits becomes `bits` bits, of which the first `low` are high for a 0, and the
    /// first `word_bytes` for a 1.
    Pulses,
    /// Commands only: colours of a strip with a clock; `elements` and `words` as for pulses. The
    /// highest byte of a colour is the brightness, 1 to 31; 0 stands for 31.
    Leds,
    /// Commands only: letters as six columns of dots each.
    Text,
}

/// Checksums between the words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Crc {
    /// No checksums.
    None,
    /// A CRC-8 after every two bytes: polynomial 0x31, start value 0xFF.
    Sensirion,
}

/// How the words of a value are coded; one word is one element.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Coding {
    /// The word number of each element; empty: in order.
    pub elements: &'static [u8],
    /// The number of words with `elements` (its greatest entry + 1); 0: as many as elements.
    pub words: u16,
    /// The format of a word.
    pub code: Code,
    /// The checksums; not for packed words, and `word_bytes * words` must be even.
    pub crc: Crc,
    /// The bytes of a word, 1 to 8; ignored for packed words.
    pub word_bytes: u8,
    /// The lowest significant bit of the word, 0 for its least significant; packed: 0.
    pub low: u8,
    /// The number of significant bits from there, 1 to 64; 0: up to the word's highest. Packed: 1
    /// to 32.
    pub bits: u8,
    /// True if the highest of the bits is a sign; ignored for floats, BCD and
    /// magnitudes.
    pub is_signed: bool,
    /// True if the word's first byte is its least significant.
    pub is_little_endian: bool,
}

impl Coding {
    /// A big-endian unsigned number in one byte.
    pub const NEW: Self = Self {
        elements: &[],
        words: 0,
        code: Code::Integer,
        crc: Crc::None,
        word_bytes: 1,
        low: 0,
        bits: 0,
        is_signed: false,
        is_little_endian: false,
    };

    /// The format of a word, as far as features allow.
    const fn code(&self) -> Code {
        if uses::CODES { self.code } else { Code::Integer }
    }

    const fn is_lamps(&self) -> bool {
        uses::LAMPS && matches!(self.code, Code::Pulses | Code::Leds)
    }

    const fn is_letters(&self) -> bool {
        uses::LETTERS && matches!(self.code, Code::Text)
    }

    const fn crc(&self) -> Crc {
        if uses::WORD_CRC { self.crc } else { Crc::None }
    }

    const fn words_of(&self, count: u16) -> usize {
        if self.words != 0 { self.words as usize } else { count as usize }
    }

    /// The size of a value with `count` elements on the wire, checksums included.
    #[must_use]
    pub const fn wire_bytes(&self, count: u16) -> usize {
        if self.is_lamps() {
            return lamps::wire_bytes(self, count);
        }
        if self.is_letters() {
            return count as usize * letters::COLUMNS;
        }
        let words = self.words_of(count);
        let data = match self.code() {
            Code::Packed => (words * self.bits as usize).div_ceil(8),
            Code::Integer
            | Code::Float
            | Code::Bcd
            | Code::Magnitude
            | Code::Pulses
            | Code::Leds
            | Code::Text => words * self.word_bytes as usize,
        };
        match self.crc() {
            Crc::None => data,
            Crc::Sensirion => data + data / 2,
        }
    }

    /// The place of a byte of the words on the wire.
    fn place(&self, byte: usize) -> usize {
        match self.crc() {
            Crc::None => byte,
            Crc::Sensirion => byte.wrapping_add(byte / 2),
        }
    }

    /// Whether each checksum in the value's bytes is right (also true without checksums).
    #[must_use]
    pub fn crc_is_right(&self, count: u16, bytes: &[u8]) -> bool {
        let bytes = bytes.get(..self.wire_bytes(count)).unwrap_or_default();
        self.crc() == Crc::None || bytes.as_chunks().0.iter().all(|[a, b, crc]| sum(*a, *b) == *crc)
    }

    /// The number of significant bits of a word; 0 if the table makes no sense.
    fn bits_of(&self) -> u32 {
        let (low, bits) = (u32::from(self.low), u32::from(self.bits));
        if self.code() == Code::Packed {
            return if bits <= PACKED_BITS_MAX { bits } else { 0 };
        }
        let word_bits = 8 * u32::from(self.word_bytes);
        if word_bits == 0 || word_bits > 64 || low >= word_bits {
            return 0;
        }
        let most = word_bits - low;
        if bits == 0 || bits > most { most } else { bits }
    }

    /// The index of an element's word; `None` if there is no such word.
    fn word_of(&self, element: usize, count: u16) -> Option<usize> {
        let word = if self.elements.is_empty() {
            element
        } else {
            usize::from(*self.elements.get(element)?)
        };
        (word < self.words_of(count)).then_some(word)
    }

    // ---- decoding ----

    /// Stores the value of an item from the first [`Self::wire_bytes`] bytes. `Fresh`; `WrongCrc`
    /// if a checksum is wrong; `Invalid` if a BCD digit is greater than 9, a float is infinite or
    /// NaN, or bytes are missing. Unless it is fresh, `value` may be partly written.
    #[must_use]
    pub fn decode(&self, item: &Item, bytes: &[u8], value: &mut [u8]) -> Outcome {
        if bytes.len() < self.wire_bytes(item.count) {
            return Outcome::Invalid;
        }
        if !self.crc_is_right(item.count, bytes) {
            return Outcome::WrongCrc;
        }
        for index in 0..usize::from(item.count) {
            let place = index.wrapping_mul(item.scalar.bytes());
            let element = value.get_mut(place..).unwrap_or_default();
            let word = self.word_of(index, item.count);
            if !word.is_some_and(|word| self.decode_element(item.scalar, bytes, word, element)) {
                return Outcome::Invalid;
            }
        }
        Outcome::Fresh
    }

    fn decode_element(
        &self,
        scalar: Scalar,
        bytes: &[u8],
        word: usize,
        element: &mut [u8],
    ) -> bool {
        let bits = self.bits_of();
        if bits == 0 {
            return false;
        }
        let code = self.code();
        let number = match code {
            Code::Packed => packed_word(bytes, word, bits as usize),
            Code::Integer
            | Code::Float
            | Code::Bcd
            | Code::Magnitude
            | Code::Pulses
            | Code::Leds
            | Code::Text => self.whole_word(bytes, word),
        };
        let number = number & mask_of(bits);
        match code {
            Code::Bcd => store_bcd(scalar, number, element),
            Code::Float => store_float(scalar, number, self.word_bytes, element),
            Code::Magnitude => {
                let sign = 1_u64.wrapping_shl(bits - 1);
                let magnitude = (number & !sign).cast_signed();
                let is_negative = number & sign != 0;
                let value = if is_negative { magnitude.wrapping_neg() } else { magnitude };
                store_signed(scalar, value, element);
                true
            }
            Code::Integer | Code::Packed | Code::Pulses | Code::Leds | Code::Text => {
                if self.is_signed {
                    let sign = 1_u64.wrapping_shl(bits - 1);
                    let extended = (number ^ sign).wrapping_sub(sign).cast_signed();
                    store_signed(scalar, extended, element);
                } else {
                    store_unsigned(scalar, number, element);
                }
                true
            }
        }
    }

    fn whole_word(&self, bytes: &[u8], word: usize) -> u64 {
        let size = usize::from(self.word_bytes);
        let first = word.wrapping_mul(size);
        let gathered = (0..size).fold(0, |gathered: u64, index| {
            let byte = if self.is_little_endian { size - 1 - index } else { index };
            gathered << 8 | u64::from(at(bytes, self.place(first.wrapping_add(byte))))
        });
        gathered.wrapping_shr(self.low.into())
    }

    // ---- encoding ----

    /// The reverse, for a device that is written to: numbers saturate to the bits available, other
    /// bits of a word are 0, and floating-point items are rounded to integers unless the words are
    /// floats. Returns the number of bytes written, 0 if they do not fit.
    #[must_use]
    pub fn encode(&self, item: &Item, value: &[u8], bytes: &mut [u8]) -> usize {
        let size = self.wire_bytes(item.count);
        let bits = self.bits_of();
        let is_other_float =
            self.code() == Code::Float && usize::from(self.word_bytes) != item.scalar.bytes();
        let Some(out) = bytes.get_mut(..size).filter(|_| bits > 0 && !is_other_float) else {
            return 0;
        };
        if self.is_lamps() {
            lamps::encode(self, item, value, out);
            return size;
        }
        if self.is_letters() {
            letters::encode(item, value, out);
            return size;
        }
        out.fill(0);
        for index in 0..usize::from(item.count) {
            let place = index.wrapping_mul(item.scalar.bytes());
            let element = value.get(place..).unwrap_or_default();
            let number = self.encode_element(item.scalar, element, bits);
            let Some(word) = self.word_of(index, item.count) else { return 0 };
            if self.code() == Code::Packed {
                put_packed(out, word, bits as usize, number);
            } else {
                self.put_word(out, word, number.wrapping_shl(self.low.into()));
            }
        }
        if self.crc() == Crc::Sensirion {
            for [a, b, crc] in out.as_chunks_mut().0 {
                *crc = sum(*a, *b);
            }
        }
        size
    }

    fn encode_element(&self, scalar: Scalar, element: &[u8], bits: u32) -> u64 {
        let mask = mask_of(bits);
        let greatest = if self.is_signed { mask >> 1 } else { mask };
        let (magnitude, is_negative) = load_magnitude(scalar, element);
        match (self.code(), is_negative) {
            (Code::Float, _) => scalar.load(element),
            (Code::Bcd, true) => 0,
            (Code::Bcd, false) => to_bcd(magnitude, mask),
            (Code::Magnitude, false) => magnitude.min(mask >> 1),
            (Code::Magnitude, true) => magnitude.min(mask >> 1) | (mask ^ (mask >> 1)),
            (_, false) => magnitude.min(greatest),
            (_, true) if !self.is_signed => 0,
            (_, true) => magnitude.min(greatest + 1).wrapping_neg() & mask,
        }
    }

    fn put_word(&self, bytes: &mut [u8], word: usize, number: u64) {
        let size = usize::from(self.word_bytes);
        let first = word.wrapping_mul(size);
        let mut rest = number;
        for index in 0..size {
            let byte = if self.is_little_endian { index } else { size - 1 - index };
            if let Some(place) = bytes.get_mut(self.place(first.wrapping_add(byte))) {
                *place = rest as u8;
            }
            rest >>= 8;
        }
    }
}

fn sum(a: u8, b: u8) -> u8 {
    crc8(SENSIRION_POLYNOMIAL, SENSIRION_START, &[a, b])
}

const fn mask_of(bits: u32) -> u64 {
    if bits >= 64 { u64::MAX } else { (1_u64 << bits) - 1 }
}

fn packed_word(bytes: &[u8], word: usize, bits: usize) -> u64 {
    let first = word.wrapping_mul(bits);
    let last = first.wrapping_add(bits).wrapping_sub(1);
    let mut gathered = 0_u64;
    for byte in (first / 8..last / 8 + 1).rev() {
        gathered = gathered << 8 | u64::from(at(bytes, byte));
    }
    gathered >> (first % 8)
}

fn put_packed(bytes: &mut [u8], word: usize, bits: usize, number: u64) {
    for index in 0..bits {
        let place = word.wrapping_mul(bits).wrapping_add(index);
        if let Some(byte) = bytes.get_mut(place / 8) {
            *byte |= ((number.wrapping_shr(index as u32) & 1) as u8) << (place % 8);
        }
    }
}

fn store_bcd(scalar: Scalar, digits: u64, element: &mut [u8]) -> bool {
    let mut number = 0_u64;
    for byte in digits.to_be_bytes() {
        let (high, low) = (byte >> 4, byte & 0xF);
        if high > 9 || low > 9 {
            return false;
        }
        number = number.wrapping_mul(100).wrapping_add(u64::from(10 * high + low));
    }
    store_unsigned(scalar, number, element);
    true
}

/// Stores IEEE 754 bits as they are; an exponent of all ones is not a number.
fn store_float(scalar: Scalar, bits: u64, word_bytes: u8, element: &mut [u8]) -> bool {
    let exponent = if word_bytes == 4 { 0x7F80_0000 } else { 0x7FF0_0000_0000_0000 };
    if usize::from(word_bytes) != scalar.bytes() || bits & exponent == exponent {
        return false;
    }
    scalar.store(bits, element);
    true
}

/// Binary-coded decimal in the bits of `mask`; saturates.
fn to_bcd(number: u64, mask: u64) -> u64 {
    let (mut rest, mut digits, mut greatest) = (number, 0, 0);
    for shift in (0..64).step_by(4) {
        let most = (mask >> shift) & 0xF;
        digits |= (rest % 10) << shift;
        greatest |= most.min(9) << shift;
        rest /= 10;
    }
    if rest > 0 || digits > mask { greatest } else { digits }
}
