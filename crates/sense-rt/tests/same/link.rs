//! The reporter over a channel that a script opens, fills and breaks; see `reporter.c`.

use std::fmt::Write as _;

use sense_rt::{
    Channel, Checksum, Health, Host, Item, Outcome, Record, Reporter, ReporterConfig, Scalar,
    Schema, Store,
};

use super::answer::{Words, say_bytes};

const ROOM_MAX: usize = 64;
const ITEMS: &[Item] = &[
    Item::sensor(17, Scalar::Uint16, 1),
    Item::sensor(18, Scalar::Uint8, 40),
    Item::actuator(33, Scalar::Int16, 1),
    Item::actuator(34, Scalar::Bool, 2),
    Item::sensor(20, Scalar::Uint32, 1),
];
const HASH: u32 = 0xC0FF_EE17;
const fn schema(stamp: bool, checksum: Checksum) -> Schema {
    Schema { items: ITEMS, hash: HASH, stamp, checksum }
}
pub(crate) const CHECKSUMS: [Checksum; 3] = [Checksum::None, Checksum::Crc16, Checksum::Crc32];
const fn with_each(stamp: bool) -> [Schema; 3] {
    let [none, crc16, crc32] = CHECKSUMS;
    [schema(stamp, none), schema(stamp, crc16), schema(stamp, crc32)]
}
static SCHEMAS: [[Schema; 3]; 2] = [with_each(false), with_each(true)];
const BYTES: usize = schema(true, Checksum::Crc32).reporter_bytes();
static CYCLES_MS: [u32; 5] = [10, 0, 0, 0, 100];

pub(crate) const OUTCOMES: [Outcome; Outcome::COUNT] = [
    Outcome::Nothing,
    Outcome::Fresh,
    Outcome::Invalid,
    Outcome::WrongCrc,
    Outcome::NotAcknowledged,
    Outcome::BusError,
    Outcome::ArbitrationLost,
    Outcome::TimedOut,
    Outcome::WrongIdentity,
];

/// The other end and the board, both of which log what happens.
#[derive(Default)]
struct Line {
    is_open: bool,
    /// The part of what is written that it accepts: all, nothing, or half.
    accepts: u64,
    room: usize,
    coming: Vec<u8>,
    reported: String,
}

impl Channel for Line {
    fn is_open(&mut self) -> bool {
        self.is_open
    }

    fn read(&mut self, bytes: &mut [u8]) -> usize {
        let size = bytes.len().min(self.coming.len());
        bytes[..size].copy_from_slice(&self.coming[..size]);
        self.coming.drain(..size);
        size
    }

    fn room(&mut self) -> usize {
        self.room
    }

    fn is_empty(&mut self) -> bool {
        self.room >= ROOM_MAX
    }

    fn write(&mut self, bytes: &[u8]) -> usize {
        assert!(!bytes.is_empty() && bytes.len() <= self.room);
        let size = match self.accepts {
            0 => bytes.len(),
            1 => return 0,
            _ => bytes.len().div_ceil(2),
        };
        self.reported.push_str(" w");
        say_bytes(&mut self.reported, &bytes[..size]);
        self.room -= size;
        size
    }
}

struct Board {
    store: Store<[u8; schema(true, Checksum::Crc32).values_bytes()]>,
    health: Health<[Record; ITEMS.len()]>,
    reported: String,
}

impl Host for Board {
    fn with(&mut self, task: &mut dyn FnMut(&mut Store, &mut Health)) {
        task(&mut self.store, &mut self.health);
    }

    fn apply(&mut self, index: usize, value: &[u8]) {
        write!(self.reported, " a{index}").unwrap();
        for element in value.chunks(ITEMS[index].scalar.bytes()) {
            write!(self.reported, ":{:x}", ITEMS[index].scalar.load(element)).unwrap();
        }
    }

    fn failsafe(&mut self) {
        self.reported.push_str(" failsafe");
    }

    fn intercept(&mut self, byte: u8) -> bool {
        byte == b'?'
    }
}

pub(crate) struct Link {
    line: Line,
    board: Board,
    reporter: Reporter<[u8; BYTES]>,
}

impl Default for Link {
    fn default() -> Self {
        Self::new(&SCHEMAS[0][0], 10, 0)
    }
}

impl Link {
    fn new(schema: &'static Schema, cycle_ms: u32, silence_ms: u32) -> Self {
        let board = Board {
            store: Store::new(schema),
            health: Health::new(&CYCLES_MS),
            reported: String::new(),
        };
        let reporter = Reporter::new(ReporterConfig { schema, cycle_ms, silence_ms });
        Self { line: Line::default(), board, reporter }
    }

    pub(crate) fn answer(&mut self, word: &str, words: &mut Words<'_>, out: &mut String) {
        match word {
            "reporter" => {
                let (stamp, checksum) = (words.number() as usize, words.number() as usize);
                let schema = &SCHEMAS[stamp][checksum];
                *self = Self::new(schema, words.small(), words.small());
                out.push_str(" 1");
            }
            "put" => self.board.store.put(words.number() as usize, &words.bytes()),
            "note" => {
                let (index, outcome) = (words.number() as usize, words.number() as usize);
                self.board.health.note(index, OUTCOMES[outcome], words.small());
            }
            "cycle" => self.cycle(words, out),
            other => panic!("{other}"),
        }
    }

    fn cycle(&mut self, words: &mut Words<'_>, out: &mut String) {
        let now_us = words.number();
        self.line.is_open = words.flag();
        self.line.accepts = words.number();
        self.line.room = words.number() as usize;
        let (is_paused, tells) = (words.flag(), words.flag());
        self.line.coming = words.bytes();
        if is_paused {
            self.reporter.pause(now_us, &mut self.board);
        } else {
            self.reporter.cycle(now_us, &mut self.line, &mut self.board);
        }
        // What arrives is applied, or the failsafe taken, before anything is sent.
        out.push_str(&std::mem::take(&mut self.board.reported));
        out.push_str(&std::mem::take(&mut self.line.reported));
        if tells {
            let counts = self.reporter.counts();
            write!(out, " {} {}", counts.reports_sent, counts.reports_refused).unwrap();
            write!(out, " {} {}", counts.frames_torn, counts.values_dropped).unwrap();
        }
    }
}
