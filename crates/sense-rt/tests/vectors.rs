//! The codec against the vectors that every codec of the project must pass, split at every place.
#![expect(clippy::disallowed_methods, reason = "a test reads its data")]
#![allow(clippy::unwrap_used, clippy::panic, clippy::indexing_slicing, reason = "a test may panic")]

use std::path::Path;

use sense_rt::{
    Bits, BoardHealth, Cause, Checksum, Decoder, Direction, FRAME_BYTES_LIMIT, Fault, Frame,
    HealthRow, Item, Scalar, Schema, Stamp, Status, encode_health, encode_health_request,
    encode_hello, encode_hello_request, encode_values,
};

fn hex(text: &str) -> Vec<u8> {
    let digits = text.as_bytes().chunks(2);
    digits.map(|two| u8::from_str_radix(str::from_utf8(two).unwrap(), 16).unwrap()).collect()
}

fn scalar(name: &str) -> Scalar {
    use Scalar::{
        Bool, Float32, Float64, Int8, Int16, Int32, Int64, Uint8, Uint16, Uint32, Uint64,
    };
    let all = [Bool, Uint8, Int8, Uint16, Int16, Uint32, Int32, Uint64, Int64, Float32, Float64];
    let found = all.into_iter().find(|one| format!("{one:?}").eq_ignore_ascii_case(name));
    found.unwrap_or_else(|| panic!("what is {name}?"))
}

/// Elements in network byte order, made only with the standard library.
fn element(scalar: Scalar, text: &str) -> Vec<u8> {
    match scalar {
        Scalar::Bool => vec![u8::from(text.parse::<bool>().unwrap())],
        Scalar::Uint8 => vec![text.parse().unwrap()],
        Scalar::Int8 => text.parse::<i8>().unwrap().to_be_bytes().into(),
        Scalar::Uint16 => text.parse::<u16>().unwrap().to_be_bytes().into(),
        Scalar::Int16 => text.parse::<i16>().unwrap().to_be_bytes().into(),
        Scalar::Uint32 => text.parse::<u32>().unwrap().to_be_bytes().into(),
        Scalar::Int32 => text.parse::<i32>().unwrap().to_be_bytes().into(),
        Scalar::Uint64 => text.parse::<u64>().unwrap().to_be_bytes().into(),
        Scalar::Int64 => text.parse::<i64>().unwrap().to_be_bytes().into(),
        Scalar::Float32 => text.parse::<f32>().unwrap().to_be_bytes().into(),
        Scalar::Float64 => text.parse::<f64>().unwrap().to_be_bytes().into(),
    }
}

/// A frame with its own copy of the content.
#[derive(Clone, Debug, PartialEq)]
enum Event {
    Values(Option<Stamp>, Vec<(usize, Vec<u8>)>),
    Hello(u32),
    Health(Vec<u8>),
    OtherHealth(u8),
    HelloRequest,
    HealthRequest,
}

impl From<Frame<'_>> for Event {
    fn from(frame: Frame<'_>) -> Self {
        match frame {
            Frame::Values(stamp, items) => {
                Self::Values(stamp, items.map(|(index, value)| (index, value.to_vec())).collect())
            }
            Frame::Hello(hash) => Self::Hello(hash),
            Frame::Health(payload) if payload[1] == 1 => Self::Health(payload.to_vec()),
            Frame::Health(payload) => Self::OtherHealth(payload[1]),
            Frame::HelloRequest => Self::HelloRequest,
            Frame::HealthRequest => Self::HealthRequest,
        }
    }
}

#[derive(Default)]
struct Case {
    name: String,
    actuators: bool,
    chunks: Vec<Vec<u8>>,
    events: Vec<Event>,
    stamp: Stamp,
    values: Vec<(usize, Vec<u8>)>,
    board: Option<BoardHealth>,
    rows: Vec<HealthRow>,
}

fn values(schema: &Schema, id: &str, texts: &[&str]) -> (usize, Vec<u8>) {
    let id: u8 = id.parse().unwrap();
    let index = schema.items.iter().position(|item| item.id == id).unwrap();
    let of = |text: &&str| element(schema.items[index].scalar, text);
    (index, texts.iter().flat_map(of).collect())
}

fn stamp(time_us: &str, counter: &str) -> Stamp {
    Stamp { time_us: time_us.parse().unwrap(), counter: counter.parse().unwrap() }
}

fn board(words: &[&str]) -> BoardHealth {
    use Cause::{Halt, LowPower, Pin, Power, Software, Unknown, Watchdog, WindowWatchdog};
    let causes = [Unknown, Power, Pin, Software, Watchdog, WindowWatchdog, LowPower, Halt];
    BoardHealth {
        uptime_ms: words[0].parse().unwrap(),
        reset_cause: causes[words[1].parse::<usize>().unwrap()],
        reset_device: words[2].parse().unwrap(),
        reports_sent: words[3].parse().unwrap(),
        reports_refused: words[4].parse().unwrap(),
        load_percent: words[5].parse().unwrap(),
        stack_left_bytes: words[6].parse().unwrap(),
    }
}

/// `STATUS AGE_MS NACK BUS ARBITRATION TIMEOUT CRC INVALID`
fn row(words: &[&str]) -> HealthRow {
    let all = [Status::Never, Status::Good, Status::Stale, Status::Failed, Status::Invalid];
    let counts: Vec<u16> = words[2..].iter().map(|count| count.parse().unwrap()).collect();
    HealthRow {
        status: all[words[0].parse::<usize>().unwrap()],
        age_ms: words[1].parse().unwrap(),
        counts: <[u16; Fault::COUNT]>::try_from(counts).unwrap(),
    }
}

/// The bytes between length and checksum, including numbers that no board sends: `UPTIME_MS CAUSE
/// DEVICE SENT REFUSED LOAD STACK`, then `ID=STATUS/AGE_MS/COUNTS` per device.
fn health_payload(words: &[&str]) -> Vec<u8> {
    let mut payload = vec![255, 1];
    let mut put = |bytes: usize, text: &str| {
        let all = text.parse::<u64>().unwrap().to_be_bytes();
        payload.extend(&all[8 - bytes..]);
    };
    for (bytes, word) in [4, 1, 1, 4, 4, 1, 2].into_iter().zip(words) {
        put(bytes, word);
    }
    for device in &words[7..] {
        let (_, cells) = device.split_once('=').unwrap();
        for (bytes, cell) in [1, 4, 2, 2, 2, 2, 2, 2].into_iter().zip(cells.split('/')) {
            put(bytes, cell);
        }
    }
    payload
}

fn event(schema: &'static Schema, words: &[&str]) -> Event {
    match words {
        ["hello-request"] => Event::HelloRequest,
        ["health-request"] => Event::HealthRequest,
        ["health-version", version] => Event::OtherHealth(version.parse().unwrap()),
        ["health", words @ ..] => Event::Health(health_payload(words)),
        ["hello", hash] => Event::Hello(u32::from_str_radix(&hash[2..], 16).unwrap()),
        items => {
            let (head, items) = match items[0].strip_prefix("stamp=") {
                None => (None, items),
                Some(text) => {
                    let (time, counter) = text.split_once('/').unwrap();
                    (Some(stamp(time, counter)), &items[1..])
                }
            };
            let of = |item: &&str| {
                let (id, list) = item.split_once('=').unwrap();
                values(schema, id, &list.split(',').collect::<Vec<_>>())
            };
            Event::Values(head, items.iter().map(of).collect())
        }
    }
}

impl Case {
    fn direction(&self) -> Direction {
        if self.actuators { Direction::ToBoard } else { Direction::ToHost }
    }

    fn encode(&self, schema: &Schema) -> Vec<u8> {
        let mut frame = vec![0xEE; schema.frame_bytes(self.direction())];
        let size = if let Some(board) = &self.board {
            encode_health(schema, board, &mut |index| self.rows[index], &mut frame)
        } else {
            let mut due = Bits::NONE;
            let mut memory = vec![0; schema.values_bytes()];
            for (index, value) in &self.values {
                due.set(*index);
                let at: usize = schema.items[..*index].iter().map(Item::bytes).sum();
                memory[at..at + value.len()].copy_from_slice(value);
            }
            encode_values(schema, self.direction(), self.stamp, &due, &memory, &mut frame)
        };
        frame.truncate(size);
        frame
    }

    fn decode(&self, schema: &'static Schema, chunks: &[&[u8]], dropped: u32, how: &str) {
        let mut decoder =
            Box::new(Decoder::<[u8; FRAME_BYTES_LIMIT]>::new(schema, self.direction()));
        let mut events: Vec<Event> = Vec::new();
        for chunk in chunks {
            decoder.feed(chunk, &mut |frame| events.push(frame.into()));
        }
        assert_eq!(events, self.events, "{} {how}", self.name);
        assert_eq!(decoder.dropped_bytes(), dropped, "{} {how}", self.name);
        assert_eq!(decoder.frames() as usize, self.events.len(), "{} {how}", self.name);
    }

    fn decode_every_way(&self, schema: &'static Schema, dropped: u32) {
        let all = self.chunks.concat();
        self.decode(schema, &[&all], dropped, "at once");
        self.decode(schema, &all.chunks(1).collect::<Vec<_>>(), dropped, "byte by byte");
        for split in 0..=all.len() {
            let (head, tail) = all.split_at(split);
            self.decode(schema, &[head, tail], dropped, &format!("cut at {split}"));
        }
    }
}

/// The schema that a file has described so far, leaked.
fn fixed(schema: Schema, items: &[Item]) -> &'static Schema {
    Box::leak(Box::new(Schema { items: items.to_vec().leak(), ..schema }))
}

fn run(path: &Path) -> usize {
    let text = std::fs::read_to_string(path).unwrap();
    let empty = Schema { items: &[], hash: 0, stamp: false, checksum: Checksum::None };
    let mut draft = empty;
    let mut items: Vec<Item> = Vec::new();
    let mut schema = fixed(draft, &items);
    let mut case = Case::default();
    let mut checks = 0;
    for line in text.lines() {
        let words: Vec<&str> = line.split_whitespace().collect();
        match words.as_slice() {
            [] | ["#", ..] => {}
            ["schema", _] => {
                draft = empty;
                items.clear();
            }
            ["checksum", "none"] => {}
            ["checksum", "crc16"] => draft.checksum = Checksum::Crc16,
            ["checksum", "crc32"] => draft.checksum = Checksum::Crc32,
            ["stamp", "on"] => draft.stamp = true,
            ["item", id, direction, _, value] => {
                let (name, count) = value.split_once('[').unwrap_or((value, "1]"));
                items.push(Item {
                    id: id.parse().unwrap(),
                    scalar: scalar(name),
                    count: count.trim_end_matches(']').parse().unwrap(),
                    direction: match *direction {
                        "sensor" => Direction::ToHost,
                        _ => Direction::ToBoard,
                    },
                });
            }
            ["hash", hash] => {
                draft.hash = u32::from_str_radix(&hash[2..], 16).unwrap();
                schema = fixed(draft, &items);
            }
            ["encode" | "encode-health"] => case = Case::default(),
            ["encode-actuators"] => case = Case { actuators: true, ..Case::default() },
            ["stamp", time, counter] => case.stamp = stamp(time, counter),
            ["board", words @ ..] => case.board = Some(board(words)),
            ["device", _, words @ ..] => case.rows.push(row(words)),
            ["value", id, texts @ ..] => case.values.push(values(schema, id, texts)),
            ["frame", bytes] => {
                assert_eq!(case.encode(schema), hex(bytes), "{line}");
                checks += 1;
            }
            ["decode", name] => case = Case { name: (*name).into(), ..Case::default() },
            ["decode-actuators", name] => {
                case = Case { name: (*name).into(), actuators: true, ..Case::default() };
            }
            ["in", bytes] => case.chunks.push(hex(bytes)),
            ["got", words @ ..] => case.events.push(event(schema, words)),
            ["dropped", count] => {
                case.decode_every_way(schema, count.parse().unwrap());
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
fn hello_and_requests_are_these_bytes() {
    const ITEMS: &[Item] =
        &[Item::sensor(17, Scalar::Uint16, 1), Item::actuator(33, Scalar::Int16, 1)];
    let plain = Schema { items: ITEMS, hash: 0x0102_0304, stamp: false, checksum: Checksum::None };
    let mut frame = [0; 96];
    let size = encode_hello(&plain, &mut frame);
    assert_eq!(&frame[..size], b"5:\0\x01\x02\x03\x04,");
    let size = encode_hello_request(&plain, &mut frame);
    assert_eq!(&frame[..size], b"1:\0,");
    let summed = Schema { checksum: Checksum::Crc16, ..plain };
    let size = encode_health_request(&summed, &mut frame);
    // CRC-16/CCITT-FALSE of 00 01, computed by hand bit by bit.
    assert_eq!(&frame[..size], b"5:\0\x01\xFF\x0D\x2E,".as_slice());
    assert_eq!(encode_hello(&plain, &mut frame[..8]), 0, "a frame is whole or not at all");
}
