//! The two checksums of the wire.

/// What a byte in the upper half of the register does to a CRC-16/CCITT-FALSE, and the same with
/// one, two and three zero bytes behind it.
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

/// The register behind one more byte.
#[inline]
pub(crate) fn crc16_step(crc: u16, byte: u8) -> u16 {
    let [one, ..] = &CRC16_TABLES;
    (crc << 8) ^ entry(one, crc.to_be_bytes()[0] ^ byte)
}

#[inline]
fn entry(table: &[u16; 256], byte: u8) -> u16 {
    // A byte is always below 256; the compiler sees it and checks nothing.
    table.get(usize::from(byte)).copied().unwrap_or_default()
}

/// CRC-16/CCITT-FALSE: polynomial 0x1021, start 0xFFFF, not reflected, no final inversion.
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

/// The product of two registers as polynomials over GF(2), modulo the one of the CRC.
#[must_use]
pub(crate) fn crc16_product(left: u16, right: u16) -> u16 {
    (0..16).rev().fold(0, |product: u16, bit| {
        let carry = if product & 0x8000 == 0 { 0 } else { 0x1021 };
        let term = if (right >> bit) & 1 == 0 { 0 } else { left };
        (product << 1) ^ carry ^ term
    })
}

/// CRC-32/ISO-HDLC (the one of zlib): of the schema's canonical text it is the schema hash.
#[must_use]
pub fn crc32_iso_hdlc(bytes: &[u8]) -> u32 {
    let mut crc = 0xFFFF_FFFF_u32;
    for &byte in bytes {
        crc ^= u32::from(byte);
        for _ in 0..8 {
            crc = if crc & 1 == 0 { crc >> 1 } else { (crc >> 1) ^ 0xEDB8_8320 };
        }
    }
    !crc
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
    }

    #[test]
    fn zero_bytes_multiply() {
        let (mut by_steps, mut power) = (0x29B1, 1);
        for _ in 0..300 {
            by_steps = crc16_step(by_steps, 0);
            power = crc16_step(power, 0);
            assert_eq!(by_steps, crc16_product(0x29B1, power));
        }
    }
}
