//! From values to Netstring frames.
//!
//! A frame is written into a buffer of the caller, whole or not at all: if the buffer is smaller
//! than [`Schema::frame_bytes`], nothing is written and 0 is returned.

use crate::bits::Bits;
use crate::bytes::{Writer, move_down};
use crate::health::{BoardHealth, HealthRow};
use crate::schema::{
    Direction, HEALTH_REQUEST, ID_HEALTH, ID_HELLO, STAMP_BYTES, Schema, head_bytes,
};

/// The version of the health format.
const HEALTH_VERSION: u8 = 1;

/// The start of a report on links with stamps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Stamp {
    /// Microseconds since the start of the board; wraps.
    pub time_us: u32,
    /// The count of reports put together; wraps.
    pub counter: u8,
}

/// Puts the values whose bit is set in `due` (bit i is `items[i]`) into a frame; `values` has all
/// of them, as in a [`crate::Store`]. Returns the size of the frame, 0 if there is nothing to send.
/// Without stamps on the link, `stamp` is ignored.
pub fn encode_values(
    schema: &Schema,
    direction: Direction,
    stamp: Stamp,
    due: &Bits,
    values: &[u8],
    frame: &mut [u8],
) -> usize {
    let mut rest = values;
    let mut put = |index: usize, out: &mut Writer<'_>| {
        let Some(item) = schema.items.get(index) else { return };
        let Some((value, others)) = rest.split_at_checked(item.bytes()) else { return };
        rest = others;
        if item.direction == direction && due.has(index) {
            out.put(&[item.id]);
            out.put(value);
        }
    };
    encode_each((schema, schema.payload_bytes_max(direction)), direction, stamp, &mut put, frame)
}

/// Like [`encode_values`], but calls `put` for one item after the other to write it if it is due: a
/// caller that locks the values then locks them for one item at a time. The schema comes with its longest payload in that
/// direction, which takes a while to compute.
pub(crate) fn encode_each(
    (schema, longest_bytes): (&Schema, usize),
    direction: Direction,
    stamp: Stamp,
    put: &mut dyn FnMut(usize, &mut Writer<'_>),
    frame: &mut [u8],
) -> usize {
    let head = if schema.stamps(direction) { STAMP_BYTES } else { 0 };
    let mut all = |out: &mut Writer<'_>| {
        if head > 0 {
            let [a, b, c, d] = stamp.time_us.to_be_bytes();
            out.put(&[ID_HELLO, a, b, c, d, stamp.counter]);
        }
        for index in 0..schema.items.len() {
            put(index, out);
        }
    };
    frame_of((schema, longest_bytes), frame, head, &mut all)
}

/// The hello of the board, with the hash of its schema.
pub fn encode_hello(schema: &Schema, frame: &mut [u8]) -> usize {
    let [a, b, c, d] = schema.hash.to_be_bytes();
    let mut put = |out: &mut Writer<'_>| out.put(&[ID_HELLO, a, b, c, d]);
    frame_of((schema, schema.payload_bytes_max(Direction::ToHost)), frame, 0, &mut put)
}

/// The health of the board, and of each device as given by `row_of`.
pub fn encode_health(
    schema: &Schema,
    board: &BoardHealth,
    row_of: &mut dyn FnMut(usize) -> HealthRow,
    frame: &mut [u8],
) -> usize {
    let mut put = |out: &mut Writer<'_>| {
        out.put(&[ID_HEALTH, HEALTH_VERSION]);
        out.put(&board.uptime_ms.to_be_bytes());
        out.put(&[board.reset_cause as u8, board.reset_device]);
        out.put(&board.reports_sent.to_be_bytes());
        out.put(&board.reports_refused.to_be_bytes());
        out.put(&[board.load_percent]);
        out.put(&board.stack_left_bytes.to_be_bytes());
        for index in 0..schema.items.len() {
            let row = row_of(index);
            out.put(&[row.status as u8]);
            out.put(&row.age_ms.to_be_bytes());
            for count in row.counts {
                out.put(&count.to_be_bytes());
            }
        }
    };
    frame_of((schema, schema.payload_bytes_max(Direction::ToHost)), frame, 0, &mut put)
}

/// The host's request for a hello.
pub fn encode_hello_request(schema: &Schema, frame: &mut [u8]) -> usize {
    let mut put = |out: &mut Writer<'_>| out.put(&[ID_HELLO]);
    frame_of((schema, schema.payload_bytes_max(Direction::ToBoard)), frame, 0, &mut put)
}

/// The host's request for health.
pub fn encode_health_request(schema: &Schema, frame: &mut [u8]) -> usize {
    let mut put = |out: &mut Writer<'_>| out.put(&[ID_HELLO, HEALTH_REQUEST]);
    frame_of((schema, schema.payload_bytes_max(Direction::ToBoard)), frame, 0, &mut put)
}

/// A payload with its checksum, length and comma. A payload of at most `empty_bytes` has no
/// content, and gives no frame.
fn frame_of(
    (schema, longest_bytes): (&Schema, usize),
    frame: &mut [u8],
    empty_bytes: usize,
    put: &mut dyn FnMut(&mut Writer<'_>),
) -> usize {
    let head_bytes = head_bytes(longest_bytes);
    if frame.len() < head_bytes + longest_bytes + 1 {
        return 0;
    }
    let mut out = Writer::new(frame.get_mut(head_bytes..).unwrap_or_default());
    put(&mut out);
    if out.size <= empty_bytes {
        return 0;
    }
    if schema.checksum.is_some() {
        let behind = schema.checksum.behind(out.written());
        out.put(behind.get(..schema.checksum_bytes()).unwrap_or_default());
    }
    let payload_bytes = out.size;
    out.put(b",");
    if out.is_full {
        return 0;
    }
    // The length is right before the payload; a short one leaves unused room before it.
    let end = head_bytes + out.size;
    let mut start = head_bytes - 1;
    put_at(frame, start, b':');
    let mut rest = payload_bytes as u16;
    loop {
        start = start.saturating_sub(1);
        put_at(frame, start, b'0' + (rest % 10) as u8);
        rest /= 10;
        if rest == 0 {
            break;
        }
    }
    move_down(frame, start, end);
    end.saturating_sub(start)
}

fn put_at(frame: &mut [u8], place: usize, byte: u8) {
    if let Some(place) = frame.get_mut(place) {
        *place = byte;
    }
}
