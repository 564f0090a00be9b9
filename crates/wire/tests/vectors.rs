//! The reference codec against the vectors that every codec of the project must pass.
//!
//! The vectors were made by another implementation (Python's `struct` and `zlib`).
#![expect(clippy::disallowed_methods, reason = "a test reads its data")]
#![allow(clippy::unwrap_used, clippy::panic, clippy::indexing_slicing, reason = "a test may panic")]

use std::path::Path;

use sensedsl_wire::{
    Checksum, Decoder, DeviceHealth, Direction, EncodeError, Event, Health, Item, ResetCause,
    Scalar, ScalarType, Schema, Stamp, Status, ValueType, encode_health, encode_health_request,
    encode_hello, encode_report, encode_stamped_report,
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
        ["health-request"] => Event::HealthRequest,
        ["health-version", version] => Event::OtherHealth(version.parse().unwrap()),
        ["health", words @ ..] => {
            let (board, devices) = words.split_at(7);
            let devices = devices
                .iter()
                .map(|device| device_health(&device.split(['=', '/']).collect::<Vec<_>>()));
            Event::Health(Health { devices: devices.collect(), ..board_health(board) })
        }
        ["hello", hash] => Event::Hello(u32::from_str_radix(&hash[2..], 16).unwrap()),
        [stamp, items @ ..] if stamp.starts_with("stamp=") => {
            let (time, counter) = stamp["stamp=".len()..].split_once('/').unwrap();
            let Event::Report(None, values) = event(schema, items) else {
                panic!("a stamp before {items:?}");
            };
            Event::Report(Some(self::stamp(time, counter)), values)
        }
        items => Event::Report(
            None,
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

fn stamp(time_us: &str, counter: &str) -> Stamp {
    Stamp { time_us: time_us.parse().unwrap(), counter: counter.parse().unwrap() }
}

/// `UPTIME_MS RESET_CAUSE RESET_DEVICE SENT REFUSED LOAD STACK`
fn board_health(words: &[&str]) -> Health {
    Health {
        uptime_ms: words[0].parse().unwrap(),
        reset_cause: ResetCause::from_code(words[1].parse().unwrap()),
        reset_device: words[2].parse().unwrap(),
        reports_sent: words[3].parse().unwrap(),
        reports_refused: words[4].parse().unwrap(),
        load_percent: words[5].parse().unwrap(),
        stack_left_bytes: words[6].parse().unwrap(),
        devices: Vec::new(),
    }
}

/// `ID STATUS AGE_MS NACK BUS ARBITRATION TIMEOUT CRC INVALID`
fn device_health(words: &[&str]) -> DeviceHealth {
    let counts: Vec<u16> = words[3..].iter().map(|count| count.parse().unwrap()).collect();
    DeviceHealth {
        id: words[0].parse().unwrap(),
        status: Status::from_code(words[1].parse().unwrap()),
        age_ms: words[2].parse().unwrap(),
        causes: <[u16; 6]>::try_from(counts).unwrap().into(),
    }
}

#[derive(Default)]
struct Case {
    name: String,
    actuators: bool,
    chunks: Vec<Vec<u8>>,
    events: Vec<Event>,
    stamp: Option<Stamp>,
    values: Values,
    health: Option<Health>,
}

impl Case {
    fn direction(&self) -> Direction {
        if self.actuators { Direction::Actuator } else { Direction::Sensor }
    }

    fn encode(&self, schema: &Schema) -> Vec<u8> {
        match (&self.health, self.stamp) {
            (Some(health), _) => encode_health(schema, health).unwrap(),
            (None, Some(stamp)) => encode_stamped_report(schema, stamp, &self.values).unwrap(),
            (None, None) => encode_report(schema, self.direction(), &self.values).unwrap(),
        }
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
            ["checksum", name] => schema.checksum = Checksum::of_name(name).unwrap(),
            ["stamp", "on"] => schema.stamp = true,
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
            ["encode-health"] => case = Case::default(),
            ["stamp", time, counter] => case.stamp = Some(stamp(time, counter)),
            ["board", words @ ..] => case.health = Some(board_health(words)),
            ["device", words @ ..] => {
                case.health.as_mut().unwrap().devices.push(device_health(words));
            }
            ["value", id, texts @ ..] => case.values.push(values(&schema, id, texts)),
            ["frame", bytes] => {
                let frame = case.encode(&schema);
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
    assert!(checks >= 400, "only {checks} vectors were found");
}

#[test]
fn full_frame_of_the_paper_is_17_bytes() {
    let schema = Schema {
        checksum: Checksum::None,
        stamp: false,
        items: [(17, "uint16"), (18, "uint16"), (19, "uint8"), (20, "uint32")]
            .map(|(id, value)| Item {
                id,
                name: format!("S{id}"),
                direction: Direction::Sensor,
                value: value_type(value),
            })
            .into(),
    };
    let number = Scalar::Unsigned;
    let values = [(17, number(300)), (18, number(0)), (19, number(255)), (20, number(100_000))]
        .map(|(id, value)| (id, vec![value]));
    assert_eq!(encode_report(&schema, Direction::Sensor, &values).unwrap().len(), 17);
    assert_eq!(encode_hello(&schema).len(), 8);
    // Health is longer than all values together: 19 bytes and 17 for each of four devices.
    assert_eq!(schema.frame_bytes_max(Direction::Sensor), 3 + 87 + 1);
    assert_eq!(schema.frame_bytes_max(Direction::Actuator), encode_health_request(&schema).len());
}

#[test]
fn only_what_a_link_has_is_encoded() {
    let bare = Schema {
        items: vec![Item {
            id: 7,
            name: "Level".into(),
            direction: Direction::Sensor,
            value: value_type("uint8"),
        }],
        ..Schema::default()
    };
    let stamped = Schema { stamp: true, ..bare.clone() };
    let values = [(7, vec![Scalar::Unsigned(1)])];
    let stamp = Stamp { time_us: 5, counter: 6 };
    let refused = Err(EncodeError::Stamp);
    assert_eq!(encode_stamped_report(&bare, stamp, &values), refused);
    assert_eq!(encode_report(&stamped, Direction::Sensor, &values), refused);
    assert_eq!(encode_stamped_report(&stamped, stamp, &[]), Err(EncodeError::Empty));
    let health = board_health(&["1", "2", "0", "3", "4", "5", "6"]);
    assert_eq!(encode_health(&bare, &health), Err(EncodeError::Devices));
    assert_ne!(bare.hash(), stamped.hash());
    assert_eq!(stamped.canonical_text(), "checksum none\nstamp\n7 sensor Level uint8\n");
}
