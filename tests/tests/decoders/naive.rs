//! The definition of decoding, as plain as possible and therefore slow: at each position, is this a
//! frame?

use sensedsl_wire::{
    Checksum, Direction, ID_CHECKSUM, ID_HEALTH, ID_HELLO, ScalarType, Schema, crc16_ccitt_false,
    crc32_iso_hdlc,
};

use super::program::Answer;

enum Verdict {
    Invalid,
    Incomplete,
    /// A payload without its checksum, and the length of the frame in bytes.
    Complete(Vec<u8>, usize),
}

/// The required answer to a stream.
pub(crate) fn decode(schema: &Schema, direction: Direction, stream: &[u8]) -> Vec<u8> {
    let mut answer = Answer::default();
    let (mut at, mut frames, mut dropped) = (0, 0, 0);
    while at < stream.len() {
        match look(schema, direction, &stream[at..]) {
            Verdict::Incomplete => break,
            Verdict::Invalid => {
                at += 1;
                dropped += 1;
            }
            Verdict::Complete(payload, bytes) => {
                at += bytes;
                frames += 1;
                answer.frame(&payload);
            }
        }
    }
    answer.end(frames, dropped)
}

fn look(schema: &Schema, direction: Direction, bytes: &[u8]) -> Verdict {
    let digits = bytes.iter().take_while(|byte| byte.is_ascii_digit()).count();
    let length = bytes[..digits].iter().try_fold(0, |length: usize, byte| {
        let length = length * 10 + usize::from(byte - b'0');
        (length > 0 && length <= schema.payload_bytes_max(direction)).then_some(length)
    });
    let Some(length) = length else { return Verdict::Invalid };
    match bytes.get(digits) {
        None => return Verdict::Incomplete,
        Some(b':') if digits > 0 && length > schema.checksum.size_bytes() => {}
        Some(_) => return Verdict::Invalid,
    }
    let here = &bytes[digits + 1..];
    let values_bytes = length - schema.checksum.size_bytes();
    let Some(mut whole) = are_values(schema, direction, here, values_bytes) else {
        return Verdict::Invalid;
    };
    let values = &here[..values_bytes.min(here.len())];
    let sum = match schema.checksum {
        Checksum::None => Vec::new(),
        Checksum::Crc16 => crc16_ccitt_false(values).to_be_bytes().to_vec(),
        Checksum::Crc32 => crc32_iso_hdlc(values).to_be_bytes().to_vec(),
    };
    let mut tail = vec![b','];
    if !sum.is_empty() {
        tail = [&[ID_CHECKSUM], &sum[..], b","].concat();
    }
    let there = here.get(values_bytes..).unwrap_or_default();
    // Only the first bytes of the checksum prove nothing: it is compared when all of it is there.
    for (index, (is, should)) in there.iter().zip(&tail).enumerate() {
        let is_in_sum = (1..=sum.len()).contains(&index);
        if is != should && !(is_in_sum && there.len() <= sum.len()) {
            return Verdict::Invalid;
        }
    }
    whole &= there.len() >= tail.len();
    if whole {
        Verdict::Complete(here[..values_bytes].to_vec(), digits + 1 + length + 1)
    } else {
        Verdict::Incomplete
    }
}

/// The maximum length in bytes of a payload other than health, without the checksum; and the length
/// of health, 0 if there is none.
fn lengths(schema: &Schema, direction: Direction) -> (usize, usize) {
    let items = schema.items.iter().filter(|item| item.direction == direction);
    let values: usize = items.map(|item| 1 + item.value.size_bytes()).sum();
    match direction {
        Direction::Sensor if schema.stamp && values > 0 => {
            (values + 6, 19 + 17 * schema.items.len())
        }
        Direction::Sensor => (values.max(5), 19 + 17 * schema.items.len()),
        Direction::Actuator => (values.max(2), 0),
    }
}

/// `None` if the bytes cannot become values; otherwise whether all of them are there.
fn are_values(schema: &Schema, direction: Direction, here: &[u8], bytes: usize) -> Option<bool> {
    let (short_bytes, health_bytes) = lengths(schema, direction);
    if bytes > short_bytes && bytes != health_bytes {
        return None;
    }
    let Some(&first) = here.first() else { return Some(false) };
    let is_stamped = schema.stamp && direction == Direction::Sensor;
    let mut at = 0;
    match (first, direction, bytes) {
        (ID_HELLO, Direction::Sensor, 5) | (ID_HELLO, Direction::Actuator, 1) => {
            return Some(here.len() >= bytes);
        }
        (ID_HELLO, Direction::Actuator, 2) => {
            return here.get(1).is_none_or(|&byte| byte == 1).then_some(here.len() >= 2);
        }
        (ID_HELLO, ..) if is_stamped && bytes > 6 && bytes <= short_bytes => at = 6,
        (ID_HEALTH, ..) if bytes == health_bytes => return Some(here.len() >= bytes),
        (ID_HELLO | ID_HEALTH, ..) => return None,
        _ if is_stamped || bytes > short_bytes => return None,
        _ => {}
    }
    let mut seen = Vec::new();
    while at < bytes {
        let Some(&id) = here.get(at) else { return Some(false) };
        let item = schema.item(direction, id)?;
        let end = at + 1 + item.value.size_bytes();
        let value = here.get(at + 1..end.min(here.len())).unwrap_or_default();
        let is_bool = item.value.scalar == ScalarType::Bool;
        if end > bytes || seen.contains(&id) || (is_bool && value.iter().any(|&byte| byte > 1)) {
            return None;
        }
        seen.push(id);
        at = end;
    }
    Some(here.len() >= bytes)
}
