//! The checksums of messages on a serial port: a word of the language in, the bytes of the sum out.

/// The checksum that a message ends with, so that a damaged one is recognised.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum MessageChecksum {
    /// No checksum.
    #[default]
    None,
    /// The low byte of the sum.
    Sum8,
    /// The low seven bits of the sum.
    Sum7,
    /// The low byte of the sum, with all bits inverted.
    NotSum8,
    /// What makes the low byte of the sum 0.
    NegSum8,
    /// What makes the low two bytes of the sum 0; the high byte first.
    NegSum16,
    /// The exclusive or of all bytes.
    Xor8,
    /// 0xFFFF minus the sum of all bytes; two bytes, the low one first.
    Ibus,
    /// A CRC-8 with polynomial 0xD5 and initial value 0.
    Crc8DvbS2,
    /// A CRC-8 with polynomial 0x4D and initial value 0.
    Crc8Ld06,
    /// The low 16 bits of the sum; two bytes, the high one first.
    Sum16,
    /// A CRC-16 with polynomial 0x8005 and initial value 0; the low byte first.
    Crc16Umts,
    /// A CRC-16 with polynomial 0x1021 and initial value 0; the high byte first.
    Crc16Xmodem,
    /// `*` and two hexadecimal digits: the exclusive or of the bytes between the start and `*`.
    Nmea,
    /// Nothing behind the body: its first two bytes are 0xA and the low half, 0x5 and the high half of the exclusive
    /// or of all others.
    Slamtec,
}

/// The words after `checksum`.
pub(crate) const CHECKSUMS: [(&str, MessageChecksum); 15] = [
    ("none", MessageChecksum::None),
    ("sum8", MessageChecksum::Sum8),
    ("sum7", MessageChecksum::Sum7),
    ("not_sum8", MessageChecksum::NotSum8),
    ("neg_sum8", MessageChecksum::NegSum8),
    ("neg_sum16", MessageChecksum::NegSum16),
    ("xor8", MessageChecksum::Xor8),
    ("ibus", MessageChecksum::Ibus),
    ("crc8_dvb_s2", MessageChecksum::Crc8DvbS2),
    ("crc8_ld06", MessageChecksum::Crc8Ld06),
    ("sum16", MessageChecksum::Sum16),
    ("crc16_umts", MessageChecksum::Crc16Umts),
    ("crc16_xmodem", MessageChecksum::Crc16Xmodem),
    ("nmea", MessageChecksum::Nmea),
    ("slamtec", MessageChecksum::Slamtec),
];

/// Those that stand behind what they are of: all but the last.
pub(crate) const SUMS_BEHIND: &[(&str, MessageChecksum)] = match CHECKSUMS.split_last() {
    Some((_, all)) => all,
    None => &[],
};

impl MessageChecksum {
    /// Whether the first byte that it covers can be chosen.
    #[must_use]
    pub const fn has_from(self) -> bool {
        !matches!(self, Self::None | Self::Nmea | Self::Slamtec)
    }

    /// Bytes of the checksum.
    #[must_use]
    pub const fn bytes(self) -> u16 {
        match self {
            Self::None | Self::Slamtec => 0,
            Self::Sum8
            | Self::Sum7
            | Self::NotSum8
            | Self::NegSum8
            | Self::Xor8
            | Self::Crc8DvbS2
            | Self::Crc8Ld06 => 1,
            Self::NegSum16 | Self::Sum16 | Self::Ibus | Self::Crc16Umts | Self::Crc16Xmodem => 2,
            Self::Nmea => 3,
        }
    }

    /// The checksum of a message whose bytes are all known; `from`: the first that it covers.
    #[must_use]
    pub fn of(self, message: &[u8], from: usize) -> Vec<u8> {
        let summed = message.get(from..).unwrap_or_default();
        let sum = summed.iter().fold(0_u16, |sum, byte| sum.wrapping_add(u16::from(*byte)));
        let [_, low] = sum.to_be_bytes();
        let xor = || summed.iter().fold(0, |sum, byte| sum ^ byte);
        match self {
            Self::None | Self::Slamtec => Vec::new(),
            Self::Sum8 => vec![low],
            Self::Sum7 => vec![low & 0x7F],
            Self::NotSum8 => vec![!low],
            Self::NegSum8 => vec![low.wrapping_neg()],
            Self::NegSum16 => sum.wrapping_neg().to_be_bytes().to_vec(),
            Self::Xor8 => vec![xor()],
            Self::Ibus => (0xFFFF - sum).to_le_bytes().to_vec(),
            Self::Crc8DvbS2 => vec![crc8(0xD5, summed)],
            Self::Crc8Ld06 => vec![crc8(0x4D, summed)],
            Self::Sum16 => sum.to_be_bytes().to_vec(),
            Self::Crc16Umts => crc16(0x8005, summed).to_le_bytes().to_vec(),
            Self::Crc16Xmodem => crc16(0x1021, summed).to_be_bytes().to_vec(),
            Self::Nmea => format!("*{:02X}", xor()).into_bytes(),
        }
    }
}

fn crc8(polynomial: u8, bytes: &[u8]) -> u8 {
    let step = |crc: u8| if crc & 0x80 == 0 { crc << 1 } else { (crc << 1) ^ polynomial };
    bytes.iter().fold(0, |crc, byte| (0..8).fold(crc ^ byte, |crc, _| step(crc)))
}

fn crc16(polynomial: u16, bytes: &[u8]) -> u16 {
    let step = |crc: u16| if crc & 0x8000 == 0 { crc << 1 } else { (crc << 1) ^ polynomial };
    let byte = |crc: u16, byte: &u8| (0..8).fold(crc ^ (u16::from(*byte) << 8), |crc, _| step(crc));
    bytes.iter().fold(0, byte)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_are_those_of_data_sheets() {
        let of = |sum: MessageChecksum, message: &[u8], from| sum.of(message, from);
        // The check values of the catalogue of CRCs.
        assert_eq!(of(MessageChecksum::Crc16Umts, b"123456789", 0), [0xE8, 0xFE]);
        assert_eq!(of(MessageChecksum::Crc16Xmodem, b"123456789", 0), [0x31, 0xC3]);
        // The ping of the e-manual of Dynamixel protocol 2.0.
        let ping = [0xFF, 0xFF, 0xFD, 0x00, 0x01, 0x03, 0x00, 0x01];
        assert_eq!(of(MessageChecksum::Crc16Umts, &ping, 0), [0x19, 0x4E]);
        // The read command of protocol 1.0: ID 1, address 43, one byte.
        let read = [0xFF, 0xFF, 0x01, 0x04, 0x02, 0x2B, 0x01];
        assert_eq!(of(MessageChecksum::NotSum8, &read, 2), [0xCC]);
        // MH-Z19B: the request for the concentration.
        let co2 = [0xFF, 0x01, 0x86, 0, 0, 0, 0, 0];
        assert_eq!(of(MessageChecksum::NegSum8, &co2, 1), [0x79]);
        // DFPlayer: play track 1.
        let play = [0x7E, 0xFF, 0x06, 0x03, 0x00, 0x00, 0x01];
        assert_eq!(of(MessageChecksum::NegSum16, &play, 1), [0xFE, 0xF7]);
        // Sabertooth: address 130, command 0, value 64.
        assert_eq!(of(MessageChecksum::Sum7, &[130, 0, 64], 0), [66]);
    }
}
