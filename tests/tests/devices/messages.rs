//! Messages in streams: however the stream is cut, damaged or filled with other data, the decoder
//! finds the same messages as a search from byte to byte.

use sensedsl_tests::{Random, hex};

use super::{check, rounds};

const NONE: usize = 0;
const SUM8: usize = 1;
const XOR8: usize = 2;
const IBUS: usize = 3;
const CRC8: usize = 4;
const NMEA: usize = 5;

/// The form of messages.
#[derive(Debug)]
struct Form {
    start: Vec<u8>,
    end: Vec<u8>,
    length: usize,
    checksum: usize,
    from: usize,
    bytes_max: usize,
}

/// The verdict on a candidate at one position.
enum Verdict {
    /// A message with this number of bytes.
    Whole(usize),
    /// Not a message.
    Bad,
    /// The stream ends too early to tell.
    Open,
}

impl Form {
    fn random(random: &mut Random) -> Self {
        let few = |random: &mut Random, most: usize| -> Vec<u8> {
            (0..random.below(most + 1)).map(|_| b"$R\n"[random.below(3)]).collect()
        };
        let (start, end) = (few(random, 3), few(random, 2));
        let length = if end.is_empty() || random.below(2) == 0 { 1 + random.below(6) } else { 0 };
        let mut form = Self {
            start,
            end,
            length,
            checksum: random.below(6),
            from: random.below(4),
            bytes_max: 0,
        };
        form.bytes_max = match length {
            0 => form.least() + random.below(12),
            _ => form.least() + random.below(2),
        };
        // A message must have at least one byte.
        form.bytes_max = form.bytes_max.max(1);
        form
    }

    fn sum_bytes(&self) -> usize {
        [0, 1, 1, 2, 1, 3][self.checksum]
    }

    fn least(&self) -> usize {
        self.start.len() + self.length + self.sum_bytes() + self.end.len()
    }

    /// The checksum of all bytes before it.
    fn sum(&self, before: &[u8]) -> Vec<u8> {
        let summed = &before[self.from.min(before.len())..];
        let total: u32 = summed.iter().map(|byte| u32::from(*byte)).sum();
        let xor = |bytes: &[u8]| bytes.iter().fold(0, |sum, byte| sum ^ byte);
        match self.checksum {
            SUM8 => vec![total as u8],
            XOR8 => vec![xor(summed)],
            IBUS => (0xFFFF_u16.wrapping_sub(total as u16)).to_le_bytes().to_vec(),
            CRC8 => {
                let divide = |crc: u8, _| crc << 1 ^ if crc & 0x80 == 0 { 0 } else { 0xD5 };
                vec![summed.iter().fold(0, |crc, byte| (0..8).fold(crc ^ byte, divide))]
            }
            NMEA => format!("*{:02X}", xor(&before[self.start.len()..])).into_bytes(),
            _ => Vec::new(),
        }
    }

    fn is_message(&self, bytes: &[u8]) -> bool {
        let Some(rest) = bytes.strip_suffix(&self.end[..]) else { return false };
        if bytes.len() < self.least() || !bytes.starts_with(&self.start) {
            return false;
        }
        let (before, sum) = rest.split_at(rest.len() - self.sum_bytes());
        let wanted = self.sum(before);
        if self.checksum == NMEA { wanted.eq_ignore_ascii_case(sum) } else { wanted == sum }
    }

    fn body<'a>(&self, message: &'a [u8]) -> &'a [u8] {
        &message[self.start.len()..message.len() - self.sum_bytes() - self.end.len()]
    }

    fn judge(&self, stream: &[u8]) -> Verdict {
        let known = stream.len().min(self.start.len());
        if stream[..known] != self.start[..known] || self.least() > self.bytes_max {
            return Verdict::Bad;
        }
        if self.length > 0 {
            return match stream.get(..self.least()) {
                None => Verdict::Open,
                Some(bytes) if self.is_message(bytes) => Verdict::Whole(bytes.len()),
                Some(_) => Verdict::Bad,
            };
        }
        for size in 1..=stream.len().min(self.bytes_max) {
            let bytes = &stream[..size];
            if size >= self.least() && bytes.ends_with(&self.end) {
                return if self.is_message(bytes) { Verdict::Whole(size) } else { Verdict::Bad };
            }
            let is_bare = self.checksum == NONE && !self.start.is_empty();
            if is_bare && size >= 2 * self.start.len() && bytes.ends_with(&self.start) {
                return Verdict::Bad;
            }
        }
        if stream.len() < self.bytes_max { Verdict::Open } else { Verdict::Bad }
    }

    /// Lines without a start: the bytes after one end and before the next.
    fn lines(&self, stream: &[u8]) -> (String, usize) {
        let mut found = String::new();
        let (mut dropped, mut begun, mut is_aligned) = (0, 0, false);
        for at in 1..=stream.len() {
            let line = &stream[begun..at];
            let is_end = line.ends_with(&self.end) && (line.len() >= self.least() || !is_aligned);
            if is_end && is_aligned && self.is_message(line) {
                found.push_str(&reported(self.body(line)));
                begun = at;
            } else if is_end || (is_aligned && line.len() == self.bytes_max) {
                dropped += line.len();
                begun = at;
                is_aligned = is_end;
            }
        }
        if !is_aligned {
            // Of a line that has not begun, only as many bytes are kept as may begin its end.
            dropped += (stream.len() - begun).saturating_sub(self.end.len() - 1);
        }
        (found, dropped)
    }

    /// The bodies of all messages, and the number of bytes that are in none of them.
    fn search(&self, stream: &[u8]) -> (String, usize) {
        if self.start.is_empty() && self.length == 0 {
            return self.lines(stream);
        }
        if self.start.is_empty() && self.checksum == NONE && self.end.is_empty() {
            return (String::new(), stream.len());
        }
        let mut found = String::new();
        let (mut at, mut dropped) = (0, 0);
        while at < stream.len() {
            match self.judge(&stream[at..]) {
                Verdict::Whole(size) => {
                    found.push_str(&reported(self.body(&stream[at..][..size])));
                    at += size;
                }
                Verdict::Bad => {
                    at += 1;
                    dropped += 1;
                }
                Verdict::Open => break,
            }
        }
        (found, dropped)
    }

    /// A message; mostly a good one.
    fn message(&self, random: &mut Random) -> Vec<u8> {
        let size = if self.length > 0 { self.length } else { random.below(8) };
        let mut bytes = self.start.clone();
        bytes.extend((0..size).map(|_| noise(random)));
        bytes.extend(self.sum(&bytes));
        bytes.extend(&self.end);
        if random.below(4) == 0 {
            let at = random.below(bytes.len().max(1));
            match random.below(3) {
                0 => bytes.truncate(at),
                1 if !bytes.is_empty() => bytes[at] = noise(random),
                _ => bytes.insert(at.min(bytes.len()), noise(random)),
            }
        }
        if random.below(3) == 0 { bytes.to_ascii_lowercase() } else { bytes }
    }
}

fn reported(body: &[u8]) -> String {
    if body.is_empty() { ";".to_owned() } else { hex(body) + ";" }
}

/// Bytes that are often part of a start or an end.
fn noise(random: &mut Random) -> u8 {
    let all = b"$R\n*0A";
    all.get(random.below(9)).copied().unwrap_or(random.next() as u8)
}

#[test]
fn messages_are_found_wherever_they_begin() {
    let mut random = Random::new(41);
    let mut cases = Vec::new();
    let mut with_messages = 0;
    for _ in 0..rounds(15_000) {
        let form = Form::random(&mut random);
        let mut stream = Vec::new();
        for _ in 0..1 + random.below(8) {
            if random.below(3) == 0 {
                stream.extend((0..random.below(20)).map(|_| noise(&mut random)));
            }
            stream.extend(form.message(&mut random));
        }
        let (found, dropped) = form.search(&stream);
        with_messages += usize::from(!found.is_empty());
        let Form { start, end, length, checksum, from, bytes_max } = &form;
        let request = format!(
            "stream {} {} {length} {checksum} {from} {bytes_max} {}",
            hex(start),
            hex(end),
            hex(&stream)
        );
        cases.push((request, format!("{found} {dropped}")));
    }
    assert!(with_messages > cases.len() / 2, "only {with_messages} of {}", cases.len());
    check(&cases);
}
