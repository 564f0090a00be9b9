//! How a plan is spelled in C, for the templates of this crate and of systems in C.

use sensedsl_model::kind::uart::MessageChecksum;
use sensedsl_model::protocol::{Crc, Drive, Format, Formula, TextField};
use sensedsl_model::words::Code;

use sensedsl_job::part::{FieldCoding, Number};

use crate::{DmaBuffer, Wiring};

/// `0x3bU`
#[must_use]
pub fn byte(byte: &u8) -> String {
    format!("0x{byte:02x}U")
}

/// The elements of an array: `0x3bU, 0x00U`.
#[must_use]
pub fn bytes(bytes: &[u8]) -> String {
    let all: Vec<String> = bytes.iter().map(byte).collect();
    all.join(", ")
}

/// The characters of a text.
pub(crate) fn text(text: &str) -> String {
    let plain = |byte: u8| {
        let is_plain = (byte.is_ascii_graphic() || byte == b' ') && !b"\"\\?".contains(&byte);
        if is_plain { char::from(byte).to_string() } else { format!("\\{byte:03o}") }
    };
    format!("\"{}\"", text.bytes().map(plain).collect::<String>())
}

/// The separator between fields; 0 if the whole message is one field.
pub(crate) fn separator(separator: &Option<u8>) -> String {
    byte(&separator.unwrap_or(0))
}

/// A part's address, or the number of its chip select or on its wire.
pub(crate) fn address(address: &u8, wiring: &Wiring) -> String {
    wiring.select.map_or_else(|| byte(address), |number| format!("{number}U"))
}

/// The macro that marks a buffer.
#[must_use]
pub const fn buffer(buffer: &DmaBuffer) -> &'static str {
    match buffer {
        DmaBuffer::Main => "UP_DMA_BUFFER",
        DmaBuffer::Basic => "UP_BDMA_BUFFER",
    }
}

/// The constant for the format of a word.
#[must_use]
pub const fn code(code: &Code) -> &'static str {
    match code {
        Code::Integer => "UP_CODE_INTEGER",
        Code::Float => "UP_CODE_FLOAT",
        Code::Bcd => "UP_CODE_BCD",
        Code::Magnitude => "UP_CODE_MAGNITUDE",
        Code::Packed => "UP_CODE_PACKED",
        Code::Pulses => "UP_CODE_PULSES",
        Code::Leds => "UP_CODE_LEDS",
        Code::Text => "UP_CODE_TEXT",
    }
}

/// The constant for the checksums between words.
#[must_use]
pub const fn crc(crc: &Option<Crc>) -> &'static str {
    match crc {
        None => "UP_CRC_NONE",
        Some(Crc::Sensirion) => "UP_CRC_SENSIRION",
    }
}

pub(crate) const fn checksum(checksum: &MessageChecksum) -> &'static str {
    match checksum {
        MessageChecksum::None => "UP_CHECKSUM_NONE",
        MessageChecksum::Sum8 => "UP_CHECKSUM_SUM8",
        MessageChecksum::Xor8 => "UP_CHECKSUM_XOR8",
        MessageChecksum::Ibus => "UP_CHECKSUM_IBUS",
        MessageChecksum::Crc8DvbS2 => "UP_CHECKSUM_CRC8_DVB_S2",
        MessageChecksum::Crc8Ld06 => "UP_CHECKSUM_CRC8_LD06",
        MessageChecksum::Sum16 => "UP_CHECKSUM_SUM16",
        MessageChecksum::Nmea => "UP_CHECKSUM_NMEA",
        MessageChecksum::Sum7 => "UP_CHECKSUM_SUM7",
        MessageChecksum::NotSum8 => "UP_CHECKSUM_NOT_SUM8",
        MessageChecksum::NegSum8 => "UP_CHECKSUM_NEG_SUM8",
        MessageChecksum::NegSum16 => "UP_CHECKSUM_NEG_SUM16",
        MessageChecksum::Crc16Umts => "UP_CHECKSUM_CRC16_UMTS",
        MessageChecksum::Crc16Xmodem => "UP_CHECKSUM_CRC16_XMODEM",
        MessageChecksum::Slamtec => "UP_CHECKSUM_SLAMTEC",
    }
}

pub(crate) const fn format(how: &FieldCoding) -> &'static str {
    match how {
        FieldCoding::Binary { .. } => "UP_FORMAT_BINARY",
        FieldCoding::Text(text) => text_format(text),
    }
}

pub(crate) const fn text_format(text: &TextField) -> &'static str {
    match text.format {
        Format::Decimal => "UP_FORMAT_DECIMAL",
        Format::Degrees => "UP_FORMAT_DEGREES",
        Format::Hex => "UP_FORMAT_HEX",
    }
}

pub(crate) const fn drive(drive: &Drive) -> &'static str {
    match drive {
        Drive::DirectionPins => "UP_DRIVE_DIRECTION_PINS",
        Drive::DirectionPin => "UP_DRIVE_DIRECTION_PIN",
        Drive::TwoPwm => "UP_DRIVE_TWO_PWM",
    }
}

/// The runtime's name of a formula.
#[must_use]
pub const fn formula(formula: &Formula) -> &'static str {
    match formula {
        Formula::Bmp280 => "up_formula_bmp280",
        Formula::Bme280 => "up_formula_bme280",
        Formula::Hx711 => "up_formula_hx711",
        Formula::Ntc => "up_formula_ntc",
        Formula::Tsl2561 => "up_formula_tsl2561",
    }
}

/// The member of `up_number_t` that holds a number.
pub(crate) const fn member(number: &Number) -> &'static str {
    match number {
        Number::Unsigned(_) => "u",
        Number::Signed(_) => "i",
        Number::Float32(_) => "f",
        Number::Float64(_) => "d",
    }
}

/// A number; a floating-point number as the shortest text that is exactly this number.
pub(crate) fn number(number: &Number) -> String {
    match number {
        Number::Unsigned(number) => format!("UINT64_C({number})"),
        // C cannot spell the least one as a literal.
        Number::Signed(i64::MIN) => "INT64_MIN".to_owned(),
        Number::Signed(number) => format!("INT64_C({number})"),
        Number::Float32(number) => format!("{number:?}F"),
        Number::Float64(number) => format!("{number:?}"),
    }
}

#[cfg(test)]
mod tests {
    use crate::{DmaBuffer, Wiring};
    use sensedsl_job::part::Number;

    use super::{address, buffer, bytes, number, separator, text};

    #[test]
    fn bytes_and_texts() {
        assert_eq!(bytes(&[0x3B, 0]), "0x3bU, 0x00U");
        assert_eq!(text("R\r?"), r#""R\015\077""#);
        assert_eq!(
            (separator(&None), separator(&Some(b','))),
            ("0x00U".to_owned(), "0x2cU".to_owned())
        );
    }

    #[test]
    fn numbers_of_all_types() {
        assert_eq!(number(&Number::Unsigned(u64::MAX)), "UINT64_C(18446744073709551615)");
        assert_eq!(number(&Number::Signed(i64::MIN)), "INT64_MIN");
        assert_eq!(number(&Number::Signed(-4)), "INT64_C(-4)");
        assert_eq!(number(&Number::Float32(0.1)), "0.1F");
        assert_eq!(number(&Number::Float64(1e30)), "1e30");
    }

    #[test]
    fn what_only_the_wiring_says() {
        let on_bus = Wiring::default();
        assert_eq!(
            (address(&0x68, &on_bus), buffer(&on_bus.buffer)),
            ("0x68U".to_owned(), "UP_DMA_BUFFER")
        );
        let selected = Wiring { buffer: DmaBuffer::Basic, select: Some(1), ..Wiring::default() };
        assert_eq!(
            (address(&0, &selected), buffer(&selected.buffer)),
            ("1U".to_owned(), "UP_BDMA_BUFFER")
        );
    }
}
