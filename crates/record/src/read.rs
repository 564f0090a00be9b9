//! Reading a record, or what is left of one.
//!
//! It is read from its begin to its end, a chunk at a time, so that a record of any length fits the memory. A chunk
//! whose checksum is wrong, or that is not whole, gives nothing at all.

use std::collections::BTreeMap;
use std::fmt;
use std::io::{self, Read};
use std::time::Duration;

use mcap::records::{MessageHeader, Record, op};
use mcap::sans_io::linear_reader::{LinearReadEvent, LinearReader, LinearReaderOptions};
use mcap::{McapError, parse_record};
use sensedsl_host::{Board, Moment, SchemaError};
use sensedsl_limits::RECORD_PART_BYTES_MAX;
use sensedsl_wire::{Direction, Scalar, ScalarType, Stamp};
use serde_json::Value;

use crate::channels::{EVENTS, HEALTH, RECEIVED, SCHEMA_FILE, SENT, topic};

/// The most bytes that are asked for at once.
const READ_BYTES: usize = 1 << 16;

/// What a record says of the past.
#[derive(Clone, Debug, PartialEq)]
pub enum Past {
    /// Bytes came from the board.
    Received(Vec<u8>),
    /// Bytes went to it.
    Sent(Vec<u8>),
    /// A sensor's value came, or an actuator was set.
    Value {
        /// The place of the device among those of its board.
        device: usize,
        /// The raw value, an element each.
        value: Vec<Scalar>,
        /// What the board said of the report.
        stamp: Option<Stamp>,
        /// How long it had been under way, where that was known.
        latency: Option<Duration>,
    },
    /// The board told how it is.
    Health(Value),
    /// The link came or went.
    Event(Value),
}

/// Something in a record.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// The place of the board in [`RecordReader::boards`].
    pub board: usize,
    /// When it was, since the run began and since 1970.
    pub at: Moment,
    /// What it was.
    pub what: Past,
}

/// How a record ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    /// With its index: whoever wrote it ended it.
    Whole,
    /// In the middle: whoever wrote it was stopped. Everything up to the last whole chunk was read.
    Cut,
}

/// Why a record cannot be read.
#[derive(Debug)]
pub enum RecordError {
    /// It is no MCAP file.
    NotMcap,
    /// It has no description of boards before the first message: another program wrote it.
    NoSchema,
    /// Its description of boards cannot be used.
    Schema(SchemaError),
    /// It is damaged: the reason.
    Damaged(String),
    /// It cannot be read.
    Io(io::Error),
}

impl fmt::Display for RecordError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotMcap => f.write_str("it is no MCAP file"),
            Self::NoSchema => {
                write!(f, "it has no attachment `{SCHEMA_FILE}`: it is no record of a board")
            }
            Self::Schema(error) => write!(f, "its `{SCHEMA_FILE}` cannot be used: {error}"),
            Self::Damaged(why) => write!(f, "it is damaged: {why}"),
            Self::Io(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for RecordError {}

/// What a channel carries.
#[derive(Clone, Copy)]
enum Carries {
    Received,
    Sent,
    Health,
    Events,
    Device(usize),
}

/// Reads a record.
pub struct RecordReader<R> {
    from: R,
    reader: LinearReader,
    boards: Vec<Board>,
    schema_json: String,
    topics: BTreeMap<String, (usize, Carries)>,
    channels: BTreeMap<u16, (usize, Carries)>,
    /// When the run began, in nanoseconds since 1970.
    first_ns: Option<u64>,
    /// The entry that was read to see what kind of file it is.
    head: Option<Entry>,
    ending: Option<Ending>,
    seen_bytes: u64,
}

impl<R: Read> RecordReader<R> {
    /// Reads until the boards of the record are known.
    ///
    /// # Errors
    /// Fails if it cannot be read, or is no record of boards.
    pub fn new(from: R) -> Result<Self, RecordError> {
        let options = LinearReaderOptions::default()
            .with_prevalidate_chunk_crcs(true)
            .with_record_length_limit(RECORD_PART_BYTES_MAX);
        let mut reader = Self {
            from,
            reader: LinearReader::new_with_options(options),
            boards: Vec::new(),
            schema_json: String::new(),
            topics: BTreeMap::new(),
            channels: BTreeMap::new(),
            first_ns: None,
            head: None,
            ending: None,
            seen_bytes: 0,
        };
        reader.head = reader.read()?;
        if reader.boards.is_empty() {
            return Err(RecordError::NoSchema);
        }
        Ok(reader)
    }

    /// The boards that it is of.
    #[must_use]
    pub fn boards(&self) -> &[Board] {
        &self.boards
    }

    /// The text that describes them.
    #[must_use]
    pub fn schema_json(&self) -> &str {
        &self.schema_json
    }

    /// When the run began.
    #[must_use]
    pub fn begin(&self) -> Moment {
        Moment {
            run: Duration::ZERO,
            unix: Duration::from_nanos(self.first_ns.unwrap_or_default()),
        }
    }

    /// The next entry; none at the end.
    ///
    /// # Errors
    /// Fails if it cannot be read any further for another reason than that it ends.
    pub fn next_entry(&mut self) -> Result<Option<Entry>, RecordError> {
        match self.head.take() {
            Some(entry) => Ok(Some(entry)),
            None => self.read(),
        }
    }

    /// How it ends, once that is known.
    #[must_use]
    pub fn ending(&self) -> Option<Ending> {
        self.ending
    }

    fn read(&mut self) -> Result<Option<Entry>, RecordError> {
        while self.ending.is_none() {
            let record = match self.reader.next_event() {
                None => {
                    self.ending = Some(Ending::Whole);
                    None
                }
                Some(Ok(LinearReadEvent::ReadRequest(wanted))) => {
                    let room = self.reader.insert(wanted.clamp(1, READ_BYTES));
                    let count = read_some(&mut self.from, room).map_err(RecordError::Io)?;
                    self.seen_bytes += count as u64;
                    self.reader.notify_read(count);
                    continue;
                }
                Some(Ok(LinearReadEvent::Record { opcode, data })) => parsed(opcode, data)?,
                Some(Err(error)) => {
                    self.end(&error)?;
                    None
                }
            };
            if let Some(entry) = record.map(|record| self.take(record)).transpose()?.flatten() {
                return Ok(Some(entry));
            }
        }
        Ok(None)
    }

    /// A record that ends anywhere is one that was stopped.
    fn end(&mut self, error: &McapError) -> Result<(), RecordError> {
        let is_over = matches!(error, McapError::UnexpectedEof | McapError::UnexpectedEoc);
        if !is_over && !matches!(error, McapError::BadMagic) {
            return Err(RecordError::Damaged(error.to_string()));
        }
        if self.boards.is_empty() && !(is_over && self.seen_bytes > 0) {
            return Err(RecordError::NotMcap);
        }
        self.ending = Some(Ending::Cut);
        Ok(())
    }

    fn take(&mut self, record: Kept) -> Result<Option<Entry>, RecordError> {
        match record {
            Kept::Schema(begin_ns, text) => {
                if self.boards.is_empty() {
                    self.first_ns = Some(begin_ns);
                    self.describe(text)?;
                }
                Ok(None)
            }
            Kept::Channel(id, topic) => {
                if self.boards.is_empty() {
                    return Err(RecordError::NoSchema);
                }
                if let Some(place) = self.topics.get(&topic) {
                    self.channels.insert(id, *place);
                }
                Ok(None)
            }
            Kept::Message(header, data) => self.message(&header, data),
        }
    }

    fn describe(&mut self, text: Vec<u8>) -> Result<(), RecordError> {
        let text = String::from_utf8(text)
            .map_err(|_| RecordError::Damaged("its schema is no text".to_owned()))?;
        self.boards = Board::all_of_json(&text).map_err(RecordError::Schema)?;
        for (index, board) in self.boards.iter().enumerate() {
            let others = [
                (RECEIVED, Carries::Received),
                (SENT, Carries::Sent),
                (HEALTH, Carries::Health),
                (EVENTS, Carries::Events),
            ];
            for (name, carries) in others {
                self.topics.insert(topic(board, name), (index, carries));
            }
            for (device, one) in board.devices.iter().enumerate() {
                self.topics.insert(topic(board, &one.name), (index, Carries::Device(device)));
            }
        }
        self.schema_json = text;
        Ok(())
    }

    fn message(
        &mut self,
        header: &MessageHeader,
        data: Vec<u8>,
    ) -> Result<Option<Entry>, RecordError> {
        // Other programs may add channels of their own.
        let Some((index, carries)) = self.channels.get(&header.channel_id).copied() else {
            return Ok(None);
        };
        let first_ns = *self.first_ns.get_or_insert(header.log_time);
        let run = Duration::from_nanos(header.log_time.saturating_sub(first_ns));
        let at = Moment { run, unix: Duration::from_nanos(header.log_time) };
        let what = match carries {
            Carries::Received => Past::Received(data),
            Carries::Sent => Past::Sent(data),
            Carries::Health => Past::Health(json(&data)?),
            Carries::Events => Past::Event(json(&data)?),
            Carries::Device(device) => self.value(index, device, header, &json(&data)?)?,
        };
        Ok(Some(Entry { board: index, at, what }))
    }

    fn value(
        &self,
        board: usize,
        index: usize,
        header: &MessageHeader,
        message: &Value,
    ) -> Result<Past, RecordError> {
        let damaged = || RecordError::Damaged(format!("a value cannot be read: {message}"));
        let board = self.boards.get(board).ok_or_else(damaged)?;
        let device = board.devices.get(index).ok_or_else(damaged)?;
        let raw = message.get("raw").ok_or_else(damaged)?;
        let all = match raw {
            Value::Array(all) => all.as_slice(),
            Value::Null
            | Value::Bool(_)
            | Value::Number(_)
            | Value::String(_)
            | Value::Object(_) => std::slice::from_ref(raw),
        };
        let value: Option<Vec<Scalar>> =
            all.iter().map(|one| scalar(one, device.value.scalar)).collect();
        let value =
            value.filter(|value| value.len() == device.value.count()).ok_or_else(damaged)?;
        let number = |name: &str| message.get(name).and_then(Value::as_u64);
        let stamp = number("stamp_us").zip(number("counter"));
        let stamp = stamp.and_then(|(time_us, counter)| {
            Some(Stamp { time_us: time_us.try_into().ok()?, counter: counter.try_into().ok()? })
        });
        let under_way = Duration::from_nanos(header.log_time.saturating_sub(header.publish_time));
        let is_sensor = device.direction == Direction::Sensor;
        let latency = stamp.filter(|_| is_sensor && !under_way.is_zero()).map(|_| under_way);
        Ok(Past::Value { device: index, value, stamp, latency })
    }
}

/// The records that count.
enum Kept {
    Schema(u64, Vec<u8>),
    Channel(u16, String),
    Message(MessageHeader, Vec<u8>),
}

fn parsed(opcode: u8, data: &[u8]) -> Result<Option<Kept>, RecordError> {
    if ![op::ATTACHMENT, op::CHANNEL, op::MESSAGE].contains(&opcode) {
        return Ok(None);
    }
    let record =
        parse_record(opcode, data).map_err(|error| RecordError::Damaged(error.to_string()))?;
    if let Record::Attachment { header, data, .. } = record {
        let is_schema = header.name == SCHEMA_FILE;
        return Ok(is_schema.then(|| Kept::Schema(header.log_time, data.into_owned())));
    }
    if let Record::Channel(channel) = record {
        return Ok(Some(Kept::Channel(channel.id, channel.topic)));
    }
    let Record::Message { header, data } = record else { return Ok(None) };
    Ok(Some(Kept::Message(header, data.into_owned())))
}

fn read_some(from: &mut impl Read, room: &mut [u8]) -> io::Result<usize> {
    loop {
        match from.read(room) {
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            other => return other,
        }
    }
}

fn json(data: &[u8]) -> Result<Value, RecordError> {
    serde_json::from_slice(data)
        .map_err(|error| RecordError::Damaged(format!("a message is no JSON: {error}")))
}

/// A raw element of a message; what is no number is `null` there.
fn scalar(value: &Value, scalar: ScalarType) -> Option<Scalar> {
    if scalar == ScalarType::Bool {
        return value.as_bool().map(Scalar::Bool);
    }
    let Some((least, most)) = scalar.integer_range() else {
        let number = if value.is_null() { f64::NAN } else { value.as_f64()? };
        let is_short = scalar == ScalarType::Float32;
        return Some(if is_short {
            Scalar::Float32(number as f32)
        } else {
            Scalar::Float64(number)
        });
    };
    let fits = |number: i128| (least..=most).contains(&number);
    if least < 0 {
        value.as_i64().filter(|number| fits(i128::from(*number))).map(Scalar::Signed)
    } else {
        value.as_u64().filter(|number| fits(i128::from(*number))).map(Scalar::Unsigned)
    }
}
