//! The checksums of the wire. Only the methods of [`Checksum`] know how they work; all other code
//! calls them.

use alloc::vec::Vec;

use crate::schema::{Checksum, ID_CHECKSUM};

/// Bytes of a number that holds any of the checksums.
const NUMBER_BYTES: usize = size_of::<u32>();

impl Checksum {
    /// All variants.
    pub const ALL: [Self; 3] = [Self::None, Self::Crc16, Self::Crc32];

    /// The word in the language.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Crc16 => "crc16",
            Self::Crc32 => "crc32",
        }
    }

    /// The checksum with that name.
    #[must_use]
    pub fn of_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|checksum| checksum.name() == name)
    }

    /// Bits of the checksum's number.
    #[must_use]
    pub const fn bits(self) -> usize {
        match self {
            Self::None => 0,
            Self::Crc16 => 16,
            Self::Crc32 => 32,
        }
    }

    /// Whether there is a checksum.
    #[must_use]
    pub const fn is_some(self) -> bool {
        self.bits() > 0
    }

    /// Bytes that it adds to each payload: its identifier and its number.
    #[must_use]
    pub const fn size_bytes(self) -> usize {
        if self.is_some() { 1 + self.bits() / 8 } else { 0 }
    }

    /// The number for a payload.
    #[must_use]
    pub fn of(self, payload: &[u8]) -> u32 {
        match self {
            Self::None => 0,
            Self::Crc16 => u32::from(crc16_ccitt_false(payload)),
            Self::Crc32 => crc32_iso_hdlc(payload),
        }
    }

    /// Appends the checksum to a payload.
    pub fn append(self, payload: &mut Vec<u8>) {
        if self.is_some() {
            let number = self.of(payload).to_be_bytes();
            payload.push(ID_CHECKSUM);
            payload.extend(number.get(NUMBER_BYTES - self.bits() / 8..).unwrap_or_default());
        }
    }

    /// The number in the bytes after the checksum's identifier; none if some bytes are missing.
    pub(crate) fn read(self, bytes: &[u8]) -> Option<u32> {
        let number = bytes.get(..self.bits() / 8)?;
        Some(number.iter().fold(0, |number, byte| number << 8 | u32::from(*byte)))
    }

    /// The initial value of the register, and the bits that are inverted at the end.
    pub(crate) const fn ends(self) -> (u32, u32) {
        match self {
            Self::None => (0, 0),
            Self::Crc16 => (0xFFFF, 0),
            Self::Crc32 => (u32::MAX, u32::MAX),
        }
    }

    /// The register value that stands for the polynomial 1.
    pub(crate) const fn one(self) -> u32 {
        match self {
            Self::None | Self::Crc16 => 1,
            Self::Crc32 => 1 << 31,
        }
    }

    /// The register after one more byte.
    #[inline]
    pub(crate) fn step(self, register: u32, byte: u8) -> u32 {
        match self {
            Self::None => 0,
            Self::Crc16 => u32::from(crc16_step(register as u16, byte)),
            Self::Crc32 => crc32_step(register, byte),
        }
    }

    /// The product of two registers as polynomials over GF(2), modulo the CRC's polynomial.
    pub(crate) fn product(self, left: u32, right: u32) -> u32 {
        match self {
            Self::None => 0,
            Self::Crc16 => u32::from(crc16_product(left as u16, right as u16)),
            Self::Crc32 => crc32_product(left, right),
        }
    }
}

/// The effect of a byte in the upper half of the register on a CRC-16/CCITT-FALSE; then the same
/// with one, two and three zero bytes after it.
const CRC16_TABLES: [[u16; 256]; 4] = crc16_tables();

#[expect(clippy::indexing_slicing, reason = "in a constant, where the compiler sees each index")]
const fn crc16_tables() -> [[u16; 256]; 4] {
    let mut tables = [[0; 256]; 4];
    let mut byte = 0;
    while byte < 256 {
        let mut crc = (byte as u16) << 8;
        let mut table = 0;
        while table < 4 {
            let mut bit = 0;
            while bit < 8 {
                crc = if crc & 0x8000 == 0 { crc << 1 } else { (crc << 1) ^ 0x1021 };
                bit += 1;
            }
            tables[table][byte] = crc;
            table += 1;
        }
        byte += 1;
    }
    tables
}

/// The same tables for CRC-32, where bytes enter at the low end.
const CRC32_TABLES: [[u32; 256]; 4] = crc32_tables();

#[expect(clippy::indexing_slicing, reason = "in a constant, where the compiler sees each index")]
const fn crc32_tables() -> [[u32; 256]; 4] {
    let mut tables = [[0; 256]; 4];
    let mut byte = 0;
    while byte < 256 {
        let mut crc = byte as u32;
        let mut table = 0;
        while table < 4 {
            let mut bit = 0;
            while bit < 8 {
                crc = crc32_shifted(crc);
                bit += 1;
            }
            tables[table][byte] = crc;
            table += 1;
        }
        byte += 1;
    }
    tables
}

const fn crc32_shifted(crc: u32) -> u32 {
    if crc & 1 == 0 { crc >> 1 } else { (crc >> 1) ^ 0xEDB8_8320 }
}

#[inline]
fn crc16_step(crc: u16, byte: u8) -> u16 {
    let [one, ..] = &CRC16_TABLES;
    (crc << 8) ^ entry(one, crc.to_be_bytes()[0] ^ byte)
}

#[inline]
fn entry<T: Copy + Default>(table: &[T; 256], byte: u8) -> T {
    // A byte is always below 256, so the compiler drops the bounds check.
    table.get(usize::from(byte)).copied().unwrap_or_default()
}

/// CRC-16/CCITT-FALSE: polynomial 0x1021, initial value 0xFFFF, not reflected, no final inversion.
#[must_use]
pub fn crc16_ccitt_false(bytes: &[u8]) -> u16 {
    let [one, two, three, four] = &CRC16_TABLES;
    let (fours, rest) = bytes.as_chunks::<4>();
    let crc = fours.iter().fold(0xFFFF_u16, |crc, &[a, b, c, d]| {
        let [high, low] = crc.to_be_bytes();
        entry(four, a ^ high) ^ entry(three, b ^ low) ^ entry(two, c) ^ entry(one, d)
    });
    rest.iter().fold(crc, |crc, &byte| crc16_step(crc, byte))
}

fn crc16_product(left: u16, right: u16) -> u16 {
    (0..16).rev().fold(0, |product: u16, bit| {
        let carry = if product & 0x8000 == 0 { 0 } else { 0x1021 };
        let term = if (right >> bit) & 1 == 0 { 0 } else { left };
        (product << 1) ^ carry ^ term
    })
}

/// The product in CRC-32's reflected form, with the highest power in the lowest bit.
fn crc32_product(left: u32, right: u32) -> u32 {
    (0..32).fold(0, |product: u32, bit| {
        let term = if (right >> bit) & 1 == 0 { 0 } else { left };
        crc32_shifted(product) ^ term
    })
}

#[inline]
fn crc32_step(crc: u32, byte: u8) -> u32 {
    let [one, ..] = &CRC32_TABLES;
    let [low, ..] = crc.to_le_bytes();
    (crc >> 8) ^ entry(one, low ^ byte)
}

/// CRC-32/ISO-HDLC (as in Ethernet and zlib): polynomial 0x04C11DB7, initial value 0xFFFFFFFF,
/// reflected, inverted at the end. For the schema's canonical text it is the schema hash.
#[must_use]
pub fn crc32_iso_hdlc(bytes: &[u8]) -> u32 {
    let [one, two, three, four] = &CRC32_TABLES;
    let (fours, rest) = bytes.as_chunks::<4>();
    let crc = fours.iter().fold(u32::MAX, |crc, &[a, b, c, d]| {
        let [low, second, third, high] = crc.to_le_bytes();
        entry(four, a ^ low)
            ^ entry(three, b ^ second)
            ^ entry(two, c ^ third)
            ^ entry(one, d ^ high)
    });
    !rest.iter().fold(crc, |crc, &byte| crc32_step(crc, byte))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn published_check_values() {
        assert_eq!(crc16_ccitt_false(b"123456789"), 0x29B1);
        assert_eq!(crc16_ccitt_false(b""), 0xFFFF);
        assert_eq!(crc16_ccitt_false(b"A"), 0xB915);
        assert_eq!(crc32_iso_hdlc(b"123456789"), 0xCBF4_3926);
        assert_eq!(crc32_iso_hdlc(b""), 0);
        assert_eq!(crc32_iso_hdlc(b"a"), 0xE8B7_BE43);
    }

    #[test]
    fn behind_a_payload() {
        let framed = |checksum: Checksum| {
            let mut payload = b"123456789".to_vec();
            checksum.append(&mut payload);
            assert_eq!(payload.len(), 9 + checksum.size_bytes());
            assert_eq!(Checksum::of_name(checksum.name()), Some(checksum));
            payload.split_off(9)
        };
        assert_eq!(framed(Checksum::None), []);
        assert_eq!(framed(Checksum::Crc16), [255, 0x29, 0xB1]);
        assert_eq!(framed(Checksum::Crc32), [255, 0xCB, 0xF4, 0x39, 0x26]);
        assert_eq!(Checksum::of_name("crc8"), None);
    }

    #[test]
    fn zero_bytes_multiply() {
        for checksum in [Checksum::Crc16, Checksum::Crc32] {
            let (mut by_steps, mut power) = (0x29B1, checksum.one());
            for _ in 0..300 {
                by_steps = checksum.step(by_steps, 0);
                power = checksum.step(power, 0);
                assert_eq!(by_steps, checksum.product(0x29B1, power));
            }
        }
    }

    #[test]
    fn steps_and_ends_give_the_number() {
        for checksum in Checksum::ALL {
            let (start, end) = checksum.ends();
            let register = b"123456789".iter().fold(start, |crc, byte| checksum.step(crc, *byte));
            assert_eq!(register ^ end, checksum.of(b"123456789"));
        }
    }
}
