//! The checksums of the link and of devices.

use crate::schema::ID_CHECKSUM;
use crate::uses;

/// The checksum at the end of payloads.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Checksum {
    /// No checksum.
    #[default]
    None,
    /// CRC-16/CCITT-FALSE.
    Crc16,
    /// CRC-32/ISO-HDLC.
    Crc32,
}

impl Checksum {
    /// Bytes of the checksum itself.
    const fn number_bytes(self) -> usize {
        match self {
            Self::None => 0,
            Self::Crc16 => 2,
            Self::Crc32 => 4,
        }
    }

    /// Whether there is one.
    #[must_use]
    pub const fn is_some(self) -> bool {
        self.number_bytes() > 0
    }

    /// Bytes that it adds to a payload: its identifier and the checksum itself.
    pub(crate) const fn bytes(self) -> usize {
        if self.is_some() { 1 + self.number_bytes() } else { 0 }
    }

    /// The bytes after a payload: the first [`Self::bytes`] of these.
    pub(crate) fn behind(self, payload: &[u8]) -> [u8; 5] {
        if uses::CRC32 && self == Self::Crc32 {
            let [a, b, c, d] = crc32(payload).to_be_bytes();
            [ID_CHECKSUM, a, b, c, d]
        } else {
            let [high, low] = crc16(payload).to_be_bytes();
            [ID_CHECKSUM, high, low, 0, 0]
        }
    }
}

/// CRC-32/ISO-HDLC of the bytes, as in Ethernet and zlib. Four bits at a time, so the table has
/// only 64 bytes.
#[must_use]
pub fn crc32(bytes: &[u8]) -> u32 {
    const OF_NIBBLE: [u32; 16] = [
        0x0000_0000,
        0x1DB7_1064,
        0x3B6E_20C8,
        0x26D9_30AC,
        0x76DC_4190,
        0x6B6B_51F4,
        0x4DB2_6158,
        0x5005_713C,
        0xEDB8_8320,
        0xF00F_9344,
        0xD6D6_A3E8,
        0xCB61_B38C,
        0x9B64_C2B0,
        0x86D3_D2D4,
        0xA00A_E278,
        0xBDBD_F21C,
    ];
    let half = |crc: u32| {
        let [low, ..] = crc.to_le_bytes();
        // A nibble is always below 16; the compiler sees that and omits the check.
        (crc >> 4) ^ OF_NIBBLE.get(usize::from(low & 15)).copied().unwrap_or_default()
    };
    !bytes.iter().fold(u32::MAX, |crc, byte| half(half(crc ^ u32::from(*byte))))
}

/// CRC-16/CCITT-FALSE of the bytes.
#[must_use]
pub fn crc16(bytes: &[u8]) -> u16 {
    // The polynomial has so few terms that eight bits can be processed at once without a table.
    bytes.iter().fold(0xFFFF, |crc: u16, byte| {
        let mut high = (crc >> 8) ^ u16::from(*byte);
        high ^= high >> 4;
        (crc << 8) ^ (high << 12) ^ (high << 5) ^ high
    })
}

/// The low 16 bits of the sum of the bytes.
#[must_use]
pub fn sum16(bytes: &[u8]) -> u16 {
    bytes.iter().fold(0, |sum: u16, byte| sum.wrapping_add(u16::from(*byte)))
}

/// The low byte of the sum of the bytes.
#[must_use]
pub fn sum8(bytes: &[u8]) -> u8 {
    bytes.iter().fold(0, |sum: u8, byte| sum.wrapping_add(*byte))
}

/// The exclusive or of all bytes.
#[must_use]
pub fn xor8(bytes: &[u8]) -> u8 {
    bytes.iter().fold(0, |sum, byte| sum ^ byte)
}

/// CRC-8 with a polynomial and a start value; most significant bit first, nothing reflected.
#[must_use]
pub fn crc8(polynomial: u8, start: u8, bytes: &[u8]) -> u8 {
    bytes.iter().fold(start, |crc, byte| {
        (0..8).fold(crc ^ byte, |crc, _| {
            let carried = if crc & 0x80 == 0 { 0 } else { polynomial };
            (crc << 1) ^ carried
        })
    })
}

/// A CRC-16 with a polynomial and start value 0; most significant bit first, nothing reflected.
#[must_use]
pub fn crc16_of(polynomial: u16, bytes: &[u8]) -> u16 {
    bytes.iter().fold(0, |crc: u16, byte| {
        (0..8).fold(crc ^ (u16::from(*byte) << 8), |crc, _| {
            let carried = if crc & 0x8000 == 0 { 0 } else { polynomial };
            (crc << 1) ^ carried
        })
    })
}
