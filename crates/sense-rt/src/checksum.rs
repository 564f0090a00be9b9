//! The checksums of the wire and of devices.

/// CRC-16/CCITT-FALSE of the bytes.
#[must_use]
pub fn crc16(bytes: &[u8]) -> u16 {
    // The polynomial has so few terms that eight bits go in at once without a table.
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

/// All bytes in exclusive or.
#[must_use]
pub fn xor8(bytes: &[u8]) -> u8 {
    bytes.iter().fold(0, |sum, byte| sum ^ byte)
}

/// CRC-8 with a polynomial, from a start; the most significant bit first, nothing turned.
#[must_use]
pub fn crc8(polynomial: u8, start: u8, bytes: &[u8]) -> u8 {
    bytes.iter().fold(start, |crc, byte| {
        (0..8).fold(crc ^ byte, |crc, _| {
            let carried = if crc & 0x80 == 0 { 0 } else { polynomial };
            (crc << 1) ^ carried
        })
    })
}
