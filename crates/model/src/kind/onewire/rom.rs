//! The address of a 1-Wire part: a text in, eight bytes out.

use sensedsl_diagnostics::codes::e0211_out_of_range;

use crate::fields::Fields;
use crate::spanned::Spanned;

/// The forms of an address, for messages.
const TAKES: &str =
    "family and serial number such as \"28-0000055f311a\", or 16 digits in the order of the wire";

/// The address of a 1-Wire part.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Rom {
    /// In the order of the wire: the family, six bytes of the serial number, the checksum.
    pub bytes: [u8; 8],
}

impl Rom {
    /// The address of that family and serial number, the lowest byte of which comes first on the wire.
    #[must_use]
    pub fn new(family: u8, serial: u64) -> Self {
        let [a, b, c, d, e, f, _, _] = serial.to_le_bytes();
        let check = crc8(&[family, a, b, c, d, e, f]);
        Self { bytes: [family, a, b, c, d, e, f, check] }
    }

    /// The family code.
    #[must_use]
    pub const fn family(self) -> u8 {
        self.bytes[0]
    }

    /// As Linux writes it: `28-0000055f311a`.
    #[must_use]
    pub fn shown(self) -> String {
        let [family, serial @ .., _] = self.bytes;
        let serial: String = serial.iter().rev().map(|byte| format!("{byte:02x}")).collect();
        format!("{family:02x}-{serial}")
    }

    /// The address that a text gives; what is wrong with it otherwise.
    fn parse(text: &str) -> Result<Self, String> {
        let not_one = || TAKES.to_owned();
        if let Some((family, serial)) = text.split_once('-').filter(|(family, _)| family.len() == 2)
        {
            let is_hex = |text: &str| text.bytes().all(|byte| byte.is_ascii_hexdigit());
            if serial.len() != 12 || !is_hex(serial) || !is_hex(family) {
                return Err(not_one());
            }
            let number = |text: &str| u64::from_str_radix(text, 16).map_err(|_| not_one());
            let family = u8::try_from(number(family)?).map_err(|_| not_one())?;
            return Ok(Self::new(family, number(serial)?));
        }
        let digits: String = text.chars().filter(|one| !matches!(one, ' ' | ':' | '-')).collect();
        let is_number = digits.len() == 16 && digits.bytes().all(|byte| byte.is_ascii_hexdigit());
        let all =
            u64::from_str_radix(&digits, 16).ok().filter(|_| is_number).ok_or_else(not_one)?;
        let bytes @ [a, b, c, d, e, f, g, check] = all.to_be_bytes();
        let right = crc8(&[a, b, c, d, e, f, g]);
        if right == check {
            Ok(Self { bytes })
        } else {
            Err(format!(
                "an address whose last byte is the checksum of the others, here {right:02X}"
            ))
        }
    }
}

/// The address of a part, which must be of its family.
pub(super) fn read(fields: &mut Fields<'_>, family: Option<u8>) -> Option<Spanned<Rom>> {
    let Spanned { value: text, span } = fields.text("rom")?;
    let range = match Rom::parse(&text) {
        Ok(rom) if family.is_none_or(|family| family == rom.family()) => {
            return Some(Spanned { value: rom, span });
        }
        Ok(_) => format!("an address of family 0x{:02X}", family.unwrap_or_default()),
        Err(range) => range,
    };
    fields.say(e0211_out_of_range::out_of_range(span, "rom", &format!("\"{text}\""), &range));
    None
}

/// The checksum of 1-Wire: polynomial x^8 + x^5 + x^4 + 1, the lowest bit first, from 0.
#[must_use]
pub fn crc8(bytes: &[u8]) -> u8 {
    bytes.iter().fold(0, |crc, byte| {
        (0..8).fold(crc ^ byte, |crc, _| if crc & 1 != 0 { crc >> 1 ^ 0x8C } else { crc >> 1 })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_forms_are_one_address() {
        // The example of Maxim's application note 27: 02 1C B8 01 00 00 00 has the checksum A2.
        let note = Rom { bytes: [0x02, 0x1C, 0xB8, 0x01, 0x00, 0x00, 0x00, 0xA2] };
        for text in [
            "02-00000001b81c",
            "021CB801000000A2",
            "02 1C B8 01 00 00 00 A2",
            "02:1c:b8:01:00:00:00:a2",
        ] {
            assert_eq!(Rom::parse(text), Ok(note), "{text}");
        }
        assert_eq!(note.shown(), "02-00000001b81c");
    }

    #[test]
    fn what_is_not_an_address_is_refused() {
        for text in [
            "",
            "28",
            "28-1234",
            "28-0000055f31zz",
            "+8-0000055f311a",
            "021CB801000000A",
            "Ü28-00",
            "28-Ü",
        ] {
            assert_eq!(Rom::parse(text), Err(TAKES.to_owned()), "{text}");
        }
        assert!(Rom::parse("021CB801000000A3").unwrap_err().contains("here A2"));
    }
}
