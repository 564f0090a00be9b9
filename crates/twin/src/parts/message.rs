//! The messages that a serial part sends by itself: binary ones with checksums, texts, sentences of NMEA 0183.

use sensedsl_model::kind::uart::{MessageChecksum, Parity, Uart};
use sensedsl_model::protocol::{Format, TextField};
use sensedsl_model::words::Words;

use super::words::{bytes, crc8};
use crate::arith::rounded;
use crate::truth::Subject;

/// The longest time between two messages: that of satellite receivers.
const PERIOD_NS_MAX: u64 = 100_000_000;

/// A value in the messages of a part.
#[derive(Clone, Debug)]
pub(crate) struct Field {
    /// The index of the subject.
    pub(crate) subject: usize,
    /// The byte, counted from the end of the start bytes, at which a binary value starts.
    pub(crate) byte: u16,
    /// The coding of a binary value.
    pub(crate) words: Option<Words>,
    /// The format in a text.
    pub(crate) text: Option<TextField>,
}

/// What the messages of a part look like.
#[derive(Clone, Debug)]
pub(super) struct Form {
    pub(super) uart: Uart,
    pub(super) fields: Vec<Field>,
}

/// A part that sends messages.
#[derive(Clone, Debug)]
pub(crate) struct MessageSender {
    form: Form,
    /// The time from one message to the next.
    period_ns: u64,
    /// The bytes of the message on the wire, and the time at which it started.
    message: Vec<u8>,
    began_ns: u64,
    sent: usize,
    /// The number of messages started so far.
    number: u64,
    /// Whether one bit of each message is another one than the part meant.
    is_spoiled: bool,
}

impl MessageSender {
    pub(crate) fn new(uart: Uart, fields: Vec<Field>, delay_ns: u64, subjects: &[Subject]) -> Self {
        let form = Form { uart, fields };
        // Text fields get longer and shorter with their values.
        let longest_ns =
            2 * form.byte_ns() * u64::try_from(form.compose(subjects, 0).len()).unwrap_or(0);
        let period_ns = longest_ns.max(delay_ns.min(PERIOD_NS_MAX)).max(1_000_000);
        Self {
            form,
            period_ns,
            message: Vec::new(),
            began_ns: 0,
            sent: 0,
            number: 0,
            is_spoiled: false,
        }
    }

    /// The time from one message to the next.
    pub(crate) const fn period_ns(&self) -> u64 {
        self.period_ns
    }

    /// The next byte that has arrived by now.
    pub(crate) fn next(&mut self, subjects: &[Subject], now_ns: u64) -> Option<u8> {
        let begins_ns = self.period_ns.saturating_mul(self.number + 1);
        if self.sent >= self.message.len() && now_ns >= begins_ns {
            // Bytes that were not taken in the meantime are lost, as they are in a receiver.
            self.number = now_ns / self.period_ns;
            self.began_ns = self.period_ns.saturating_mul(self.number);
            self.message = self.form.compose(subjects, self.began_ns);
            self.spoil();
            self.sent = 0;
        }
        let byte = *self.message.get(self.sent)?;
        let arrived =
            u64::try_from(self.sent + 1).unwrap_or(u64::MAX).saturating_mul(self.form.byte_ns());
        if now_ns < self.began_ns.saturating_add(arrived) {
            return None;
        }
        self.sent += 1;
        Some(byte)
    }

    /// From the next message on, one bit of each is wrong, or none.
    pub(crate) const fn set_spoiled(&mut self, is_spoiled: bool) {
        self.is_spoiled = is_spoiled;
    }

    /// Turns one bit of the message round, another one each time: the steps are prime, so all have their turn.
    fn spoil(&mut self) {
        const STEP: u64 = 7_919;
        let bits = 8 * u64::try_from(self.message.len()).unwrap_or(0).max(1);
        let bit = self.number.wrapping_mul(STEP) % bits;
        let place = usize::try_from(bit / 8).unwrap_or(0);
        if let Some(byte) = self.message.get_mut(place).filter(|_| self.is_spoiled) {
            *byte ^= 1 << (bit % 8);
        }
    }

    /// Drops the message on the wire: the cable is torn.
    pub(crate) fn torn(&mut self) {
        self.message.clear();
        self.sent = 0;
    }
}

impl Form {
    pub(super) fn byte_ns(&self) -> u64 {
        let parity = u64::from(self.uart.parity != Parity::None);
        let bits = 1 + u64::from(self.uart.data_bits) + parity + u64::from(self.uart.stop_bits);
        bits * 1_000_000_000 / u64::from(self.uart.baud.max(1))
    }

    /// One message of each sentence, or the only message.
    pub(super) fn compose(&self, subjects: &[Subject], now_ns: u64) -> Vec<u8> {
        let is_text = self.fields.iter().any(|field| field.text.is_some());
        if !is_text {
            return framed(&self.uart, &self.binary(subjects, now_ns));
        }
        let mut sentences: Vec<Option<&str>> = Vec::new();
        for text in self.fields.iter().filter_map(|field| field.text.as_ref()) {
            if !sentences.contains(&text.sentence.as_deref()) {
                sentences.push(text.sentence.as_deref());
            }
        }
        let bodies = sentences.iter().map(|sentence| self.text(*sentence, subjects, now_ns));
        bodies.flat_map(|body| framed(&self.uart, body.as_bytes())).collect()
    }

    fn binary(&self, subjects: &[Subject], now_ns: u64) -> Vec<u8> {
        let mut body = vec![0_u8; usize::from(self.uart.length_bytes)];
        for field in &self.fields {
            let (Some(words), Some(subject)) = (&field.words, subjects.get(field.subject)) else {
                continue;
            };
            let raw: Vec<f64> =
                (0..subject.signals.len()).map(|element| subject.raw(element, now_ns)).collect();
            let coded = bytes(words, &raw);
            for (target, byte) in body.iter_mut().skip(usize::from(field.byte)).zip(coded) {
                *target |= byte;
            }
        }
        body
    }

    fn text(&self, sentence: Option<&str>, subjects: &[Subject], now_ns: u64) -> String {
        let mut columns: Vec<String> = Vec::new();
        let mut separator = None;
        for field in &self.fields {
            let Some(text) =
                field.text.as_ref().filter(|text| text.sentence.as_deref() == sentence)
            else {
                continue;
            };
            separator = text.separator;
            let Some(subject) = subjects.get(field.subject) else { continue };
            let width = if text.format == Format::Degrees { 2 } else { 1 };
            for element in 0..subject.signals.len() {
                let first = usize::from(text.field) + element * width;
                let raw = subject.raw(element, now_ns);
                for (column, written) in written(text, raw).into_iter().enumerate() {
                    if columns.len() <= first + column {
                        columns.resize(first + column + 1, String::new());
                    }
                    if let Some(target) = columns.get_mut(first + column) {
                        *target = written;
                    }
                }
            }
        }
        // A receiver that has a position fix says so.
        if sentence == Some("RMC")
            && let Some(status) = columns.get_mut(1).filter(|status| status.is_empty())
        {
            "A".clone_into(status);
        }
        let separator =
            separator.map_or_else(|| ",".to_owned(), |byte| char::from(byte).to_string());
        match sentence {
            None => columns.join(&separator),
            Some(sentence) => format!("GP{sentence}{separator}{}", columns.join(&separator)),
        }
    }
}

/// A message: its start, body, checksum and end.
pub(crate) fn framed(uart: &Uart, body: &[u8]) -> Vec<u8> {
    let mut all = [&uart.start, body].concat();
    let summed = all.get(usize::from(uart.checksum_from)..).unwrap_or_default();
    let sum = summed.iter().fold(0_u16, |sum, byte| sum.wrapping_add(u16::from(*byte)));
    let xor = |bytes: &[u8]| bytes.iter().fold(0, |sum, byte| sum ^ byte);
    let checksum = match uart.checksum {
        MessageChecksum::None => Vec::new(),
        MessageChecksum::Slamtec => {
            headed(&mut all);
            Vec::new()
        }
        MessageChecksum::Sum8 => vec![sum.to_be_bytes()[1]],
        MessageChecksum::Xor8 => vec![xor(summed)],
        MessageChecksum::Ibus => (0xFFFF - sum).to_le_bytes().to_vec(),
        MessageChecksum::Crc8DvbS2 => vec![crc8(summed, 0xD5, 0)],
        MessageChecksum::Crc8Ld06 => vec![crc8(summed, 0x4D, 0)],
        MessageChecksum::Sum16 => sum.to_be_bytes().to_vec(),
        MessageChecksum::Nmea => format!("*{:02X}", xor(body)).into_bytes(),
        MessageChecksum::Sum7 => vec![sum.to_be_bytes()[1] % 128],
        MessageChecksum::NotSum8 => vec![255 - sum.to_be_bytes()[1]],
        MessageChecksum::NegSum8 => vec![(0x1_0000_u32 - u32::from(sum)).to_be_bytes()[3]],
        MessageChecksum::NegSum16 => {
            let [_, _, high, low] = (0x1_0000_u32 - u32::from(sum)).to_be_bytes();
            vec![high, low]
        }
        MessageChecksum::Crc16Umts => {
            let mut sum = crc16(summed, 0x8005);
            sum.reverse();
            sum.to_vec()
        }
        MessageChecksum::Crc16Xmodem => crc16(summed, 0x1021).to_vec(),
    };
    all.extend(checksum);
    all.extend(&uart.end);
    all
}

/// Puts the marks of a Slamtec capsule and the two halves of its sum over its first two bytes.
fn headed(capsule: &mut [u8]) {
    if let [first, second, rest @ ..] = capsule {
        let sum = rest.iter().fold(0, |sum, byte| sum ^ byte);
        (*first, *second) = (0xA0 + sum % 16, 0x50 + sum / 16);
    }
}

/// A 16-bit CRC from 0, as a division of polynomials: the bits of the message, and sixteen zeros behind them, are
/// shifted through the remainder. The high byte first.
fn crc16(bytes: &[u8], polynomial: u32) -> [u8; 2] {
    let bits =
        bytes.iter().chain(&[0, 0]).flat_map(|byte| (0..8).rev().map(move |at| byte >> at & 1));
    let rest = bits.fold(0_u32, |rest, bit| {
        let next = rest << 1 | u32::from(bit);
        if next & 0x1_0000 == 0 { next } else { (next ^ polynomial) & 0xFFFF }
    });
    let [_, _, high, low] = rest.to_be_bytes();
    [high, low]
}

/// A value as the text that a part is sent.
pub(crate) fn told(text: &TextField, raw: &[f64]) -> Vec<u8> {
    let all: Vec<String> = raw.iter().flat_map(|raw| written(text, *raw)).collect();
    let separator = text.separator.map_or_else(String::new, |byte| char::from(byte).to_string());
    all.join(&separator).into_bytes()
}

/// A number as it is written in a text; for degrees, the next column as well.
fn written(text: &TextField, raw: f64) -> Vec<String> {
    match text.format {
        Format::Hex => vec![format!("{:X}", rounded(raw).max(0))],
        Format::Decimal => vec![decimal(rounded(raw), u32::from(text.decimals))],
        Format::Degrees => {
            let whole = rounded(raw);
            let size = whole.unsigned_abs();
            let (degrees, rest) = (size / 10_000_000, size % 10_000_000);
            // Minutes are written with five decimals; one is 1/60 of a degree.
            let minutes = (rest * 60 + 50) / 100;
            let side = match (is_latitude(text), whole < 0) {
                (true, false) => "N",
                (true, true) => "S",
                (false, false) => "E",
                (false, true) => "W",
            };
            let (minutes, behind) = (minutes / 100_000, minutes % 100_000);
            vec![format!("{degrees:02}{minutes:02}.{behind:05}"), side.to_owned()]
        }
    }
}

/// Whether the degrees are north or south, not east or west: NMEA 0183 says so for each sentence.
fn is_latitude(text: &TextField) -> bool {
    const COLUMNS: [(&str, u8); 4] = [("GLL", 0), ("GGA", 1), ("GNS", 1), ("RMC", 2)];
    let is_in = |sentence: &str| {
        COLUMNS.iter().any(|(name, column)| sentence.ends_with(name) && text.field == *column)
    };
    text.sentence.as_deref().is_some_and(is_in)
}

/// A number divided by a power of ten.
fn decimal(number: i64, decimals: u32) -> String {
    let sign = if number < 0 { "-" } else { "" };
    let size = number.unsigned_abs();
    let unit = 10_u64.saturating_pow(decimals);
    if decimals == 0 {
        return format!("{sign}{size}");
    }
    let digits = usize::try_from(decimals).unwrap_or(0);
    format!("{sign}{}.{:0digits$}", size / unit, size % unit)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_in_texts() {
        assert_eq!(decimal(-5, 2), "-0.05");
        assert_eq!(decimal(1234, 0), "1234");
        let degrees = |field| TextField {
            sentence: Some("RMC".to_owned()),
            field,
            separator: Some(b','),
            format: Format::Degrees,
            decimals: 0,
        };
        // The example of NMEA 0183: 48 degrees 07.038 minutes north.
        assert_eq!(written(&degrees(2), 481_173_000.0), ["4807.03800", "N"]);
        assert_eq!(written(&degrees(4), -115_166_667.0), ["1131.00000", "W"]);
    }
}
