//! Schemas and streams that are difficult for a decoder: frames, bytes that look like frames,
//! frames within values within frames, and damage.

use sensedsl_tests::Random;
use sensedsl_wire::{
    Causes, Checksum, DeviceHealth, Direction, Health, ID_HEALTH, Item, ResetCause, ScalarType,
    Schema, Status, ValueType, encode_health, encode_health_request, encode_hello,
    encode_hello_request,
};

/// A schema of sensors from `(identifier, type, elements)`; one element is a plain scalar.
pub(crate) fn schema(checksum: Checksum, items: &[(u8, ScalarType, u16)]) -> Schema {
    let items = items.iter().map(|&(id, scalar, count)| Item {
        id,
        name: format!("S{id}"),
        direction: Direction::Sensor,
        value: ValueType { scalar, length: (count != 1).then_some(count) },
    });
    Schema { checksum, stamp: false, items: items.collect() }
}

/// The paper's Fig. 2.
pub(crate) fn fig2(checksum: Checksum) -> Schema {
    use ScalarType::{Uint8, Uint16, Uint32};
    schema(checksum, &[(17, Uint16, 1), (18, Uint16, 1), (19, Uint8, 1), (20, Uint32, 1)])
}

/// The schema, with stamps.
pub(crate) fn stamped(schema: Schema) -> Schema {
    Schema { stamp: true, ..schema }
}

/// Schemas whose values and identifiers can be mistaken for framing.
pub(crate) fn hard_schemas(checksum: Checksum) -> Vec<Schema> {
    use ScalarType::{Bool, Int64, Uint8, Uint16};
    let digits_and_marks = (b'0'..=b':').chain([b',']).map(|id| (id, Uint8, 1));
    let all = (1..=254).map(|id| (id, if id == b'a' { Uint16 } else { Uint8 }, 1));
    let mut actuators = fig2(checksum);
    for (item, direction) in
        actuators.items.iter_mut().zip([Direction::Sensor, Direction::Actuator].into_iter().cycle())
    {
        item.direction = direction;
    }
    vec![
        fig2(checksum),
        actuators,
        Schema { checksum, ..Schema::default() },
        Schema { checksum, stamp: true, ..Schema::default() },
        stamped(fig2(checksum)),
        stamped(schema(checksum, &[(b'1', Bool, 3), (b'9', Uint8, 2), (b',', Uint16, 1)])),
        // As long as the health of its devices: 19 bytes, plus 17 for each device.
        schema(checksum, &[(b'a', Uint8, 43), (1, Bool, 8)]),
        stamped(schema(checksum, &[(b'a', Uint8, 60), (b':', Uint8, 5)])),
        schema(checksum, &digits_and_marks.collect::<Vec<_>>()),
        schema(checksum, &all.collect::<Vec<_>>()),
        schema(checksum, &[(1, Bool, 30), (b'a', Uint8, 60), (b'1', Bool, 1), (b'b', Bool, 9)]),
        schema(checksum, &[(b'a', Uint8, 700), (1, Bool, 400), (2, Int64, 1), (b':', Uint8, 5)]),
    ]
}

/// A schema with all identifiers, some of them wide, so that candidates overlap and are long.
pub(crate) fn wide_schema(checksum: Checksum) -> Schema {
    let item = |id| match id {
        b'a' => (id, ScalarType::Uint8, 341),
        b'b' => (id, ScalarType::Uint8, 200),
        b'c' => (id, ScalarType::Bool, 1),
        b'd' => (id, ScalarType::Uint16, 1),
        _ => (id, ScalarType::Uint8, 1),
    };
    schema(checksum, &(1..=254).map(item).collect::<Vec<_>>())
}

/// Candidates from many positions that reach the same identifiers, and end at some comma there;
/// sometimes an identifier is unknown, out of turn or one byte late.
pub(crate) fn overlapping_walks(random: &mut Random, schema: &Schema) -> Vec<u8> {
    let heads = 10 + random.below(50);
    let mut pad = Vec::new();
    let (rounds, first) = (1 + random.below(3), random.below(254));
    let step = [1, 3, 253][random.below(3)];
    let damage = [30, 300, 3000][random.below(3)];
    for turn in 0..rounds * 254 {
        let id = 1 + ((first + turn * step) % 254) as u8;
        let is_wide = matches!(id, b'a'..=b'd');
        match random.below(damage) {
            0 => pad.push(likely(random, schema)),
            1 => pad.extend([likely(random, schema), 1]),
            _ if is_wide => {}
            _ => pad.extend([id, if random.below(3) == 0 { likely(random, schema) } else { b',' }]),
        }
    }
    let mut stream = Vec::new();
    for _ in 0..heads {
        let payload = stream.len() + 4;
        let commas = (0..pad.len()).filter(|&at| pad.get(at) == Some(&b','));
        let lengths = commas.map(|at| heads * 5 + at - payload);
        let lengths: Vec<usize> = lengths.filter(|length| (400..1000).contains(length)).collect();
        let length = match lengths.len() {
            0 => 999,
            count => lengths[random.below(count)],
        };
        stream.extend(format!("{length}:").as_bytes());
        stream.push(b"aaaabbcd,1"[random.below(10)]);
    }
    stream.extend(pad);
    stream
}

/// The frame of a payload, with the checksum that the schema requires.
pub(crate) fn frame(schema: &Schema, payload: &[u8]) -> Vec<u8> {
    let mut payload = payload.to_vec();
    schema.checksum.append(&mut payload);
    [format!("{}:", payload.len()).as_bytes(), &payload, b","].concat()
}

/// A payload of some items in any order, with `depth` levels of streams nested in its values.
fn payload(random: &mut Random, schema: &Schema, direction: Direction, depth: usize) -> Vec<u8> {
    let mut items: Vec<&Item> =
        schema.items.iter().filter(|item| item.direction == direction).collect();
    let most = if random.below(9) == 0 { 300 } else { 5 };
    let wanted = 1 + random.below(items.len().min(most));
    let mut payload = Vec::new();
    if schema.stamp && direction == Direction::Sensor && random.below(20) > 0 {
        payload.push(0);
        payload.extend((0..5).map(|_| likely(random, schema)));
    }
    while !items.is_empty() && payload.len() < 2000 && wanted > schema.items.len() - items.len() {
        let item = items.swap_remove(random.below(items.len()));
        payload.push(item.id);
        let bytes = item.value.size_bytes();
        if item.value.scalar == ScalarType::Bool {
            payload.extend((0..bytes).map(|_| random.below(2) as u8));
            continue;
        }
        let mut value = Vec::new();
        if depth > 0 && bytes > 3 {
            value = hard_stream(random, schema, direction, 1 + bytes / 8, depth - 1);
        }
        value.resize_with(bytes, || likely(random, schema));
        payload.extend(value);
    }
    payload
}

fn likely(random: &mut Random, schema: &Schema) -> u8 {
    match random.below(4) {
        0 => b"0123456789:,\x00\x01\xff"[random.below(15)],
        1 => schema.items.get(random.below(schema.items.len())).map_or(0, |item| item.id),
        _ => random.next() as u8,
    }
}

/// Health with arbitrary numbers; sometimes of another version or length.
fn health(random: &mut Random, schema: &Schema) -> Vec<u8> {
    let mut counts = [0; 6];
    let devices = schema.items.iter().map(|item| {
        counts.fill_with(|| random.next() as u16);
        DeviceHealth {
            id: item.id,
            status: Status::from_code(random.below(6) as u8),
            age_ms: random.next() as u32,
            causes: Causes::from(counts),
        }
    });
    let devices = devices.collect();
    let health = Health {
        uptime_ms: random.next() as u32,
        reset_cause: ResetCause::from_code(random.below(9) as u8),
        reset_device: random.next() as u8,
        reports_sent: random.next() as u32,
        reports_refused: random.next() as u32,
        load_percent: random.next() as u8,
        stack_left_bytes: random.next() as u16,
        devices,
    };
    let bytes = encode_health(schema, &health).unwrap();
    let mut payload = bytes[bytes.iter().position(|&byte| byte == ID_HEALTH).unwrap()..].to_vec();
    payload.truncate(payload.len() - 1 - schema.checksum.size_bytes());
    match random.below(6) {
        0 => payload[1] = random.below(4) as u8,
        1 => payload.resize(payload.len() + 1 - random.below(3), 0),
        _ => return bytes,
    }
    frame(schema, &payload)
}

/// Complete frames, damaged frames and bytes that look like frames.
pub(crate) fn hard_stream(
    random: &mut Random,
    schema: &Schema,
    direction: Direction,
    parts: usize,
    depth: usize,
) -> Vec<u8> {
    let max = schema.payload_bytes_max(direction);
    let mut stream = Vec::new();
    for _ in 0..1 + random.below(parts) {
        match random.below(14) {
            0 => stream.push(likely(random, schema)),
            1 => stream.extend(format!("{}:", random.below(max + 3)).as_bytes()),
            2 => {
                let byte = likely(random, schema);
                stream.resize(stream.len() + random.below(max + 2), byte);
            }
            3 if direction == Direction::Sensor => stream.extend(encode_hello(schema)),
            3 if random.below(2) == 0 => stream.extend(encode_hello_request(schema)),
            3 => stream.extend(encode_health_request(schema)),
            // A command as for an actuator with the identifier 0, or a wrong request.
            12 if direction == Direction::Actuator => {
                stream.extend(frame(schema, &[0, random.below(3) as u8]));
            }
            12 => stream.extend(health(random, schema)),
            4 => stream.extend((0..random.below(20)).map(|_| random.next() as u8)),
            kind => {
                let payload = payload(random, schema, direction, depth);
                let mut bytes = frame(schema, &payload);
                match kind {
                    5 => bytes.truncate(random.below(bytes.len())),
                    6 => drop(bytes.drain(..random.below(bytes.len()))),
                    7 | 8 => {
                        let at = random.below(bytes.len());
                        bytes[at] = likely(random, schema);
                    }
                    9 => bytes.insert(random.below(bytes.len()), likely(random, schema)),
                    _ => {}
                }
                stream.extend(bytes);
            }
        }
    }
    stream
}
