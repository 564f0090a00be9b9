//! Conversion of numbers to the bytes that a part sends: the inverse of the board's decoding.

use sensedsl_model::kind::i2c::ByteOrder;
use sensedsl_model::protocol::Crc;
use sensedsl_model::words::{Code, Words};

/// The bytes of a value, checksums included. A word without an element is 0.
pub(crate) fn bytes(words: &Words, raw: &[f64]) -> Vec<u8> {
    if words.code == Code::Packed {
        return packed(words, raw);
    }
    let size = usize::from(words.word_bytes);
    let mut all = vec![0; usize::from(words.data_bytes)];
    for (element, raw) in raw.iter().enumerate() {
        let place = match words.elements.get(element) {
            Some(place) => usize::from(*place),
            None if words.elements.is_empty() => element,
            None => continue,
        };
        let word = word(words, *raw);
        if let Some(target) = all.get_mut(place * size..(place + 1) * size) {
            target.copy_from_slice(word.get(8 - size..).unwrap_or_default());
            if words.order == ByteOrder::Little {
                target.reverse();
            }
        }
    }
    match words.crc {
        None => all,
        Some(Crc::Sensirion) => all
            .chunks(2)
            .flat_map(|pair| pair.iter().copied().chain([crc8(pair, 0x31, 0xFF)]))
            .collect(),
    }
}

/// The least and the greatest number that a word holds; `None` if it does not hold integers.
pub(crate) fn range(words: &Words) -> Option<(f64, f64)> {
    let bits = u32::from(words.bits).min(53);
    let full = crate::arith::number(1 << bits);
    match words.code {
        Code::Float => None,
        Code::Bcd => {
            let digits = u32::from(words.bits).div_ceil(4).min(15);
            Some((0.0, f64::from(10_u32.pow(digits.min(9))) - 1.0))
        }
        Code::Magnitude => Some((1.0 - full / 2.0, full / 2.0 - 1.0)),
        Code::Integer | Code::Packed if words.is_signed => Some((-full / 2.0, full / 2.0 - 1.0)),
        Code::Integer | Code::Packed | Code::Pulses | Code::Leds | Code::Text => {
            Some((0.0, full - 1.0))
        }
    }
}

/// A word, most significant byte first, at the end of eight bytes.
fn word(words: &Words, raw: f64) -> [u8; 8] {
    match words.code {
        Code::Float if words.word_bytes == 8 => raw.to_bits().to_be_bytes(),
        #[expect(clippy::cast_possible_truncation, reason = "the word has no more digits")]
        Code::Float => u64::from((raw as f32).to_bits()).to_be_bytes(),
        Code::Bcd => (bcd(held(words, raw)) << words.low).to_be_bytes(),
        Code::Magnitude => {
            let number = held(words, raw);
            let sign = u64::from(number < 0) << words.bits.saturating_sub(1);
            ((number.unsigned_abs() | sign) << words.low).to_be_bytes()
        }
        Code::Integer | Code::Packed | Code::Pulses | Code::Leds | Code::Text => {
            (masked(held(words, raw), words.bits) << words.low).to_be_bytes()
        }
    }
}

/// The nearest number that the word can hold.
fn held(words: &Words, raw: f64) -> i64 {
    let bounded = range(words).map_or(raw, |(least, greatest)| raw.round().clamp(least, greatest));
    crate::arith::rounded(bounded)
}

/// The lowest bits of a number.
fn masked(number: i64, bits: u8) -> u64 {
    let mask = if bits >= 64 { u64::MAX } else { (1 << bits) - 1 };
    u64::from_be_bytes(number.to_be_bytes()) & mask
}

/// Two decimal digits in each byte.
fn bcd(number: i64) -> u64 {
    let mut rest = number.unsigned_abs();
    let mut all = 0;
    for digit in 0..16 {
        all |= (rest % 10) << (4 * digit);
        rest /= 10;
    }
    all
}

/// Elements without gaps, from the lowest bit of the first byte on.
fn packed(words: &Words, raw: &[f64]) -> Vec<u8> {
    let mut all = vec![0_u8; usize::from(words.data_bytes)];
    for (element, raw) in raw.iter().enumerate() {
        let place = words.elements.get(element).map_or(element, |place| usize::from(*place));
        let number = masked(held(words, *raw), words.bits);
        for bit in 0..usize::from(words.bits) {
            let at = place * usize::from(words.bits) + bit;
            if (number >> bit) & 1 == 1
                && let Some(byte) = all.get_mut(at / 8)
            {
                *byte |= 1 << (at % 8);
            }
        }
    }
    all
}

/// An 8-bit CRC, most significant bit first.
pub(crate) fn crc8(bytes: &[u8], polynomial: u8, start: u8) -> u8 {
    bytes.iter().fold(start, |crc, byte| {
        (0..8).fold(
            crc ^ byte,
            |crc, _| {
                if crc & 0x80 != 0 { (crc << 1) ^ polynomial } else { crc << 1 }
            },
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(code: Code, word_bytes: u8, low: u8, bits: u8, is_signed: bool) -> Words {
        Words {
            code,
            word_bytes,
            count: 1,
            elements: Vec::new(),
            low,
            bits,
            is_signed,
            order: ByteOrder::Big,
            crc: None,
            data_bytes: u16::from(word_bytes),
        }
    }

    #[test]
    fn words_are_what_data_sheets_say() {
        // TMP102: 25 degrees are 0x190 in the upper 12 bits.
        assert_eq!(bytes(&words(Code::Integer, 2, 4, 12, true), &[400.0]), [0x19, 0x00]);
        assert_eq!(bytes(&words(Code::Integer, 2, 4, 12, true), &[-400.0]), [0xE7, 0x00]);
        let little = Words { order: ByteOrder::Little, ..words(Code::Integer, 2, 0, 16, false) };
        assert_eq!(bytes(&little, &[0x1234.into()]), [0x34, 0x12]);
        assert_eq!(bytes(&words(Code::Bcd, 1, 0, 8, false), &[59.0]), [0x59]);
        // AM2302: -10.1 degrees are 0x8065.
        assert_eq!(bytes(&words(Code::Magnitude, 2, 0, 16, false), &[-101.0]), [0x80, 0x65]);
        assert_eq!(bytes(&words(Code::Integer, 2, 0, 16, false), &[70_000.0]), [0xFF, 0xFF]);
        let float = words(Code::Float, 4, 0, 32, false);
        assert_eq!(bytes(&float, &[1.5]), 1.5_f32.to_be_bytes());
    }

    #[test]
    fn sensirion_words_have_their_checksums() {
        // The example of the SHT3x data sheet: CRC(0xBEEF) = 0x92.
        let one = Words { crc: Some(Crc::Sensirion), ..words(Code::Integer, 2, 0, 16, false) };
        assert_eq!(bytes(&one, &[f64::from(0xBEEF)]), [0xBE, 0xEF, 0x92]);
    }

    #[test]
    fn packed_channels_begin_at_the_lowest_bit() {
        let sbus = Words { data_bytes: 3, count: 2, ..words(Code::Packed, 0, 0, 11, false) };
        assert_eq!(bytes(&sbus, &[1.0, 2.0]), [0x01, 0x10, 0x00]);
    }
}
