//! One stream, several decoders: the events, the frames and the dropped bytes are the same, however
//! the stream is cut.
//!
//! The bytes choose a schema and a stream of frames, damaged frames and noise. The reference is
//! crate `wire`; the fuzzer adds the decoders in C and C++, which this crate cannot call.

use sensedsl_wire::{
    Checksum, Decoder, DeviceHealth, Direction, Event, Health, ID_HEALTH, Item, ResetCause, Scalar,
    ScalarType, Schema, Stamp, Status, ValueType, encode_health, encode_health_request,
    encode_hello, encode_hello_request, encode_report, encode_stamped_report,
};

use crate::draw::Draw;

/// What a decoder is given.
#[derive(Clone, Debug)]
pub struct Stream {
    /// Which items there are.
    pub schema: Schema,
    /// Which way the stream goes.
    pub direction: Direction,
    /// The bytes.
    pub bytes: Vec<u8>,
    /// Where they are cut, in order.
    pub cuts: Vec<usize>,
}

/// What a decoder makes of it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Decoded {
    /// A report is `R`, identifiers with their bytes, `.`, and before it where there are stamps `S` with
    /// time and counter; a hello `H` and its hash; health `D` and its payload; its other versions `V` and
    /// the version; a request `Q`, and for health `A`.
    pub log: Vec<u8>,
    /// Frames delivered.
    pub frames: u64,
    /// Bytes of no frame.
    pub dropped_bytes: u64,
}

/// A decoder.
pub type Decode = fn(&Stream) -> Decoded;

/// The reference.
#[must_use]
pub fn reference(stream: &Stream) -> Decoded {
    let mut decoder = Decoder::new(&stream.schema, stream.direction);
    let mut log = Vec::new();
    let mut from = 0;
    for to in stream.cuts.iter().copied().chain([stream.bytes.len()]) {
        decoder.feed(&stream.bytes[from..to], |event| record(&stream.schema, &event, &mut log));
        from = to;
    }
    Decoded { log, frames: decoder.frames(), dropped_bytes: decoder.dropped_bytes() }
}

fn record(schema: &Schema, event: &Event, log: &mut Vec<u8>) {
    match event {
        Event::Report(stamp, values) => {
            if let Some(stamp) = stamp {
                log.push(b'S');
                log.extend(stamp.time_us.to_be_bytes());
                log.push(stamp.counter);
            }
            log.push(b'R');
            for (id, scalars) in values {
                log.push(*id);
                let item = schema.items.iter().find(|item| item.id == *id).expect("a known item");
                for scalar in scalars {
                    assert!(item.value.scalar.write(*scalar, log), "a value of another type");
                }
            }
            log.push(b'.');
        }
        Event::Hello(hash) => {
            log.push(b'H');
            log.extend(hash.to_be_bytes());
        }
        Event::Health(health) => {
            log.push(b'D');
            log.extend(health_payload(schema, health));
        }
        Event::OtherHealth(version) => log.extend([b'V', *version]),
        Event::HelloRequest => log.push(b'Q'),
        Event::HealthRequest => log.push(b'A'),
    }
}

/// Health as it stands in a frame without a checksum.
fn health_payload(schema: &Schema, health: &Health) -> Vec<u8> {
    let bare = Schema { checksum: Checksum::None, ..schema.clone() };
    let frame = encode_health(&bare, health).expect("the devices of the schema");
    let start = frame.iter().position(|&byte| byte == ID_HEALTH).unwrap_or_default();
    frame[start..frame.len() - 1].to_vec()
}

/// The body where there are no other decoders.
pub fn rust_alone(bytes: &[u8]) {
    run(bytes, &[]);
}

/// Streams that an input stands for: with each checksum, both ways, whole and cut, as it is and
/// with one byte changed in several ways (what calling costs is then paid once for all of them).
pub const STREAMS: u64 = 12 * CHANGES;
/// The input itself is the first of them.
const CHANGES: u64 = 8;

/// The body of the target: every decoder against the reference.
///
/// # Panics
/// Where two differ.
pub fn run(bytes: &[u8], others: &[(&str, Decode)]) {
    let mut bytes = bytes.to_vec();
    // FNV-1a: which bytes are changed depends only on the input.
    let mut state = bytes.iter().fold(0xCBF2_9CE4_8422_2325_u64, |state, byte| {
        (state ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01B3)
    });
    for change in 0..CHANGES {
        if change > 0 {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(change);
            let at = (state >> 33) as usize % bytes.len().max(1);
            bytes.iter_mut().skip(at).take(1).for_each(|byte| *byte = (state >> 24) as u8);
        }
        for checksum in Checksum::ALL {
            for to_board in [false, true] {
                let mut stream = stream(&bytes, checksum, to_board);
                let cut = decoded(&stream, others);
                stream.cuts.clear();
                let whole = decoded(&stream, others);
                assert_eq!(whole, cut, "pieces make a difference: {stream:?}");
                assert!(whole.dropped_bytes <= stream.bytes.len() as u64);
            }
        }
    }
}

fn decoded(stream: &Stream, others: &[(&str, Decode)]) -> Decoded {
    let expected = reference(stream);
    for (name, decode) in others {
        assert_eq!(decode(stream), expected, "{name} differs from the reference: {stream:?}");
    }
    expected
}

/// The types of a schema by its number: few and short ones, so that noise looks like frames.
fn schema(draw: &mut Draw<'_>, checksum: Checksum) -> Schema {
    let count = 1 + draw.below(6);
    let first = draw.below(7);
    let items = (0..count).map(|at| {
        let scalar = ScalarType::ALL[draw.below(ScalarType::ALL.len())];
        let length = if draw.chance(32) { Some(1 + draw.below(4) as u16) } else { None };
        // Identifiers that look like digits, colons and commas are the hardest.
        let id = [49, 58, 44, 17, 48, 254, 1][(first + at) % 7];
        let direction = if draw.chance(64) { Direction::Actuator } else { Direction::Sensor };
        Item { id, name: String::new(), direction, value: ValueType { scalar, length } }
    });
    let items = items.collect();
    Schema { checksum, stamp: draw.chance(96), items }
}

/// The stream that the bytes stand for.
#[must_use]
pub fn stream(bytes: &[u8], checksum: Checksum, to_board: bool) -> Stream {
    let mut draw = Draw::new(bytes);
    let mut schema = schema(&mut draw, checksum);
    let direction = if to_board { Direction::Actuator } else { Direction::Sensor };
    if !schema.items.iter().any(|item| item.direction == direction) {
        schema.items[0].direction = direction;
    }
    let mut cuts: Vec<usize> = (0..draw.below(4)).map(|_| draw.below(64)).collect();
    let each_byte = draw.chance(32);
    let mut bytes = Vec::new();
    while !draw.is_done() && bytes.len() < 4096 {
        piece(&mut draw, &schema, direction, &mut bytes);
    }
    if each_byte {
        cuts = (0..bytes.len()).collect();
    }
    cuts.iter_mut().for_each(|cut| *cut = (*cut).min(bytes.len()));
    cuts.sort_unstable();
    bytes.shrink_to_fit();
    Stream { schema, direction, bytes, cuts }
}

/// Noise, a frame, or a frame that something happened to.
fn piece(draw: &mut Draw<'_>, schema: &Schema, direction: Direction, out: &mut Vec<u8>) {
    let choice = draw.byte();
    match choice {
        0..=0x7F => out.push(choice),
        0x80..=0x9F => out.extend(frame(draw, schema, direction)),
        0xA0..=0xAF => {
            let frame = frame(draw, schema, direction);
            let end = draw.below(frame.len());
            out.extend(&frame[..end]);
        }
        0xB0..=0xBF => {
            let mut frame = frame(draw, schema, direction);
            let at = draw.below(frame.len());
            frame[at] ^= draw.byte();
            out.extend(frame);
        }
        0xC0..=0xCF => {
            let mut frame = frame(draw, schema, direction);
            let at = draw.below(frame.len());
            frame.remove(at);
            out.extend(frame);
        }
        0xD0..=0xD7 => out.extend(encode_hello(schema)),
        0xD8..=0xDB => out.extend(encode_hello_request(schema)),
        0xDC | 0xDD => out.extend(encode_health_request(schema)),
        0xDE | 0xDF => out.extend(health(draw, schema)),
        0xE0..=0xEF => out.extend(std::iter::repeat_n(draw.byte(), usize::from(choice & 15) + 2)),
        _ => out.push(draw.byte()),
    }
}

/// Health of few numbers; where it is damaged, it is by other pieces.
fn health(draw: &mut Draw<'_>, schema: &Schema) -> Vec<u8> {
    let counts = [0; 6].map(|_: u16| u16::from(draw.byte()) * 257);
    let devices = schema.items.iter().map(|item| DeviceHealth {
        id: item.id,
        status: Status::from_code(draw.byte()),
        age_ms: u32::from(draw.byte()) * 0x0101_0101,
        causes: counts.into(),
    });
    let devices = devices.collect();
    let health = Health {
        uptime_ms: u32::from(draw.byte()) * 0x0101_0101,
        reset_cause: ResetCause::from_code(draw.byte()),
        reset_device: draw.byte(),
        reports_sent: u32::from(draw.byte()) * 0x0101_0101,
        reports_refused: 0x313A_002C,
        load_percent: draw.byte(),
        stack_left_bytes: u16::from(draw.byte()) * 257,
        devices,
    };
    encode_health(schema, &health).expect("the devices of the schema")
}

/// A frame of our own, which is one event when nothing else comes.
fn frame(draw: &mut Draw<'_>, schema: &Schema, direction: Direction) -> Vec<u8> {
    let mut values: Vec<(u8, Vec<Scalar>)> = Vec::new();
    let items: Vec<&Item> =
        schema.items.iter().filter(|item| item.direction == direction).collect();
    let chosen = 1 + draw.below((1 << items.len()) - 1);
    for (at, item) in items.iter().enumerate() {
        if chosen & (1 << at) == 0 || values.iter().any(|(id, _)| *id == item.id) {
            continue;
        }
        let scalars = (0..item.value.count()).map(|_| {
            let mut bytes = [0; 8];
            bytes.fill_with(|| draw.byte());
            let scalar = item.value.scalar.read(&bytes[..item.value.scalar.size_bytes()]);
            scalar.unwrap_or(Scalar::Bool(true))
        });
        values.push((item.id, scalars.collect()));
    }
    if schema.stamp && direction == Direction::Sensor {
        let time_us = u32::from(draw.byte()) * 0x0101_0101;
        let stamp = Stamp { time_us, counter: draw.byte() };
        return encode_stamped_report(schema, stamp, &values).expect("values of the schema");
    }
    encode_report(schema, direction, &values).expect("values of the schema")
}
