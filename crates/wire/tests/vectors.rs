//! The reference codec against the vectors that every codec of the project must pass.
//!
//! The vectors were made by another implementation (Python's `struct` and `zlib`).
#![expect(clippy::disallowed_methods, reason = "a test reads its data")]
#![allow(clippy::unwrap_used, clippy::panic, clippy::indexing_slicing, reason = "a test may panic")]

use std::path::Path;

use sensedsl_wire::{
    Checksum, Decoder, Direction, Event, Item, Scalar, ScalarType, Schema, ValueType, encode_hello,
    encode_report,
};

type Values = Vec<(u8, Vec<Scalar>)>;

fn hex(text: &str) -> Vec<u8> {
    assert!(text.len().is_multiple_of(2), "odd hex: {text}");
    (0..text.len())
        .step_by(2)
        .map(|at| u8::from_str_radix(&text[at..at + 2], 16).unwrap())
        .collect()
}

fn value_type(text: &str) -> ValueType {
    match text.split_once('[') {
        None => ValueType::scalar(ScalarType::from_name(text).unwrap()),
        Some((scalar, length)) => ValueType {
            scalar: ScalarType::from_name(scalar).unwrap(),
            length: Some(length.trim_end_matches(']').parse().unwrap()),
        },
    }
}

fn scalar(scalar: ScalarType, text: &str) -> Scalar {
    match scalar {
        ScalarType::Bool => Scalar::Bool(text.parse().unwrap()),
        ScalarType::Uint8 | ScalarType::Uint16 | ScalarType::Uint32 | ScalarType::Uint64 => {
            Scalar::Unsigned(text.parse().unwrap())
        }
        ScalarType::Int8 | ScalarType::Int16 | ScalarType::Int32 | ScalarType::Int64 => {
            Scalar::Signed(text.parse().unwrap())
        }
        ScalarType::Float32 => Scalar::Float32(text.parse().unwrap()),
        ScalarType::Float64 => Scalar::Float64(text.parse().unwrap()),
    }
}

fn values(schema: &Schema, id: &str, texts: &[&str]) -> (u8, Vec<Scalar>) {
    let id: u8 = id.parse().unwrap();
    let item = schema.items.iter().find(|item| item.id == id).unwrap();
    (id, texts.iter().map(|text| scalar(item.value.scalar, text)).collect())
}

fn event(schema: &Schema, words: &[&str]) -> Event {
    match words {
        ["hello-request"] => Event::HelloRequest,
        ["hello", hash] => Event::Hello(u32::from_str_radix(&hash[2..], 16).unwrap()),
        items => Event::Report(
            items
                .iter()
                .map(|item| {
                    let (id, list) = item.split_once('=').unwrap();
                    values(schema, id, &list.split(',').collect::<Vec<_>>())
                })
                .collect(),
        ),
    }
}

#[derive(Default)]
struct Case {
    name: String,
    actuators: bool,
    chunks: Vec<Vec<u8>>,
    events: Vec<Event>,
    values: Values,
}

impl Case {
    fn direction(&self) -> Direction {
        if self.actuators { Direction::Actuator } else { Direction::Sensor }
    }

    fn decode(&self, schema: &Schema, chunks: &[&[u8]], dropped: u64, how: &str) {
        let mut decoder = Decoder::new(schema, self.direction());
        let mut events = Vec::new();
        for chunk in chunks {
            decoder.feed(chunk, |event| events.push(event));
        }
        assert_eq!(events, self.events, "{} {how}", self.name);
        assert_eq!(decoder.dropped_bytes(), dropped, "{} {how}", self.name);
        assert_eq!(decoder.frames() as usize, self.events.len(), "{} {how}", self.name);
    }

    fn decode_every_way(&self, schema: &Schema, dropped: u64) {
        let all = self.chunks.concat();
        self.decode(schema, &[&all], dropped, "at once");
        self.decode(schema, &all.chunks(1).collect::<Vec<_>>(), dropped, "byte by byte");
        for split in 0..=all.len() {
            let (head, tail) = all.split_at(split);
            self.decode(schema, &[head, tail], dropped, &format!("cut at {split}"));
        }
    }
}

fn run(path: &Path) -> usize {
    let text = std::fs::read_to_string(path).unwrap();
    let mut schema = Schema::default();
    let mut case = Case::default();
    let mut checks = 0;
    for line in text.lines() {
        let words: Vec<&str> = line.split_whitespace().collect();
        match words.as_slice() {
            [] | ["#", ..] => {}
            ["schema", _] => schema = Schema::default(),
            ["checksum", "none"] => schema.checksum = Checksum::None,
            ["checksum", "crc16"] => schema.checksum = Checksum::Crc16,
            ["item", id, direction, name, value] => schema.items.push(Item {
                id: id.parse().unwrap(),
                name: (*name).into(),
                direction: match *direction {
                    "sensor" => Direction::Sensor,
                    _ => Direction::Actuator,
                },
                value: value_type(value),
            }),
            ["hash", hash] => assert_eq!(format!("0x{:08x}", schema.hash()), *hash),
            ["encode"] => case = Case::default(),
            ["encode-actuators"] => case = Case { actuators: true, ..Case::default() },
            ["value", id, texts @ ..] => case.values.push(values(&schema, id, texts)),
            ["frame", bytes] => {
                let frame = encode_report(&schema, case.direction(), &case.values).unwrap();
                assert_eq!(frame, hex(bytes));
                assert!(frame.len() <= schema.frame_bytes_max(case.direction()));
                checks += 1;
            }
            ["decode", name] => case = Case { name: (*name).into(), ..Case::default() },
            ["decode-actuators", name] => {
                case = Case { name: (*name).into(), actuators: true, ..Case::default() };
            }
            ["in", bytes] => case.chunks.push(hex(bytes)),
            ["got", words @ ..] => case.events.push(event(&schema, words)),
            ["dropped", count] => {
                case.decode_every_way(&schema, count.parse().unwrap());
                checks += 1;
            }
            other => panic!("{}: what is {other:?}?", path.display()),
        }
    }
    checks
}

#[test]
fn every_vector_passes() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/vectors");
    let mut files: Vec<_> =
        std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.retain(|file| file.extension().is_some_and(|extension| extension == "txt"));
    files.sort();
    let checks: usize = files.iter().map(|path| run(path)).sum();
    assert!(checks >= 160, "only {checks} vectors were found");
}

#[test]
fn full_frame_of_the_paper_is_17_bytes() {
    let schema = Schema {
        checksum: Checksum::None,
        items: [(17, "uint16"), (18, "uint16"), (19, "uint8"), (20, "uint32")]
            .map(|(id, value)| Item {
                id,
                name: format!("S{id}"),
                direction: Direction::Sensor,
                value: value_type(value),
            })
            .into(),
    };
    assert_eq!(schema.frame_bytes_max(Direction::Sensor), 17);
    assert_eq!(encode_hello(&schema).len(), 8);
}
