//! Writing a record while the run lasts.
//!
//! What is not yet in a chunk is lost if the program is killed, so chunks are closed each second. They are put together
//! in memory and written at once: a file never ends in the middle of one that was begun long ago.

use std::collections::BTreeMap;
use std::io::{self, Seek, Write};
use std::time::Duration;

use mcap::records::MessageHeader;
use mcap::{Attachment, McapError, WriteOptions, Writer};
use sensedsl_host::{Board, Moment, News, Report, What, status};
use sensedsl_wire::{Health, NEVER_MS, Scalar};
use serde_json::{Value, json};

use crate::channels::{
    EVENTS, HEALTH, JSON, JSON_SCHEMA, OCTETS, PROFILE, RECEIVED, SCHEMA_FILE, SENT, about,
    open_schema, topic, value_schema,
};
use crate::text::{elements, raw, shown};

/// After that time a chunk is closed.
const CHUNK_LASTS: Duration = Duration::from_secs(1);
/// A chunk with so many bytes is closed at once.
const CHUNK_BYTES: usize = 1 << 20;

/// The channels of one board.
struct Channels {
    devices: Vec<u16>,
    health: u16,
    events: u16,
    received: u16,
    sent: u16,
}

/// A record that is written.
pub struct Recorder<W: Write + Seek> {
    writer: Writer<W>,
    boards: Vec<Board>,
    channels: Vec<Channels>,
    sequences: BTreeMap<u16, u32>,
    /// The bytes of messages in the chunk that is open, and when it was opened.
    pending: usize,
    opened: Duration,
    message: Vec<u8>,
}

impl<W: Write + Seek> Recorder<W> {
    /// Begins a record of boards whose `schema.json` is given. The writer is only written to and never goes back.
    ///
    /// # Errors
    /// Fails if it cannot be written to.
    pub fn new(to: W, schema_json: &str, boards: &[Board], now: Moment) -> io::Result<Self> {
        let options = WriteOptions::new()
            .profile(PROFILE)
            .library(concat!("sensedsl ", env!("CARGO_PKG_VERSION")))
            .chunk_size(None)
            .disable_seeking(true);
        let mut writer = options.create(to).map_err(failed)?;
        let log_time = nanoseconds(now.unix);
        writer
            .attach(&Attachment {
                log_time,
                create_time: log_time,
                name: SCHEMA_FILE.to_owned(),
                media_type: "application/json".to_owned(),
                data: schema_json.as_bytes().into(),
            })
            .map_err(failed)?;
        let channels = boards.iter().map(|board| Channels::new(&mut writer, board));
        let channels = channels.collect::<Result<Vec<_>, _>>().map_err(failed)?;
        let (sequences, boards) = (BTreeMap::new(), boards.to_vec());
        let mut recorder = Self {
            writer,
            boards,
            channels,
            sequences,
            pending: 0,
            opened: now.run,
            message: Vec::new(),
        };
        recorder.writer.flush().map_err(failed)?;
        Ok(recorder)
    }

    /// Writes down what happened.
    ///
    /// # Errors
    /// Fails if the writer does. The record ends there, and stays readable.
    pub fn take(&mut self, news: &News<'_>) -> io::Result<()> {
        let Some(channels) = self.channels.get(news.board) else { return Ok(()) };
        let at = news.at;
        match news.what {
            What::Received(bytes) => self.put(channels.received, at, Duration::ZERO, bytes)?,
            What::Sent(bytes) => self.put(channels.sent, at, Duration::ZERO, bytes)?,
            What::Online => self.json(channels.events, at, &json!({ "event": "online" }))?,
            What::Offline(why) => {
                let event = json!({ "event": "offline", "why": why });
                self.json(channels.events, at, &event)?;
            }
            What::Report(report) => self.report(news.board, at, report)?,
            What::Command { device, value } => self.value(news.board, at, (device, value), None)?,
            What::Health(health) => {
                let (id, health) = (channels.health, self.health(news.board, health));
                self.json(id, at, &health)?;
            }
        }
        self.close_chunk(at.run)
    }

    /// Closes the chunk if it is time; called when nothing happens, too.
    ///
    /// # Errors
    /// Fails if the writer does.
    pub fn close_chunk(&mut self, now: Duration) -> io::Result<()> {
        if self.pending == 0 {
            self.opened = now;
            return Ok(());
        }
        if self.pending < CHUNK_BYTES && now.saturating_sub(self.opened) < CHUNK_LASTS {
            return Ok(());
        }
        (self.pending, self.opened) = (0, now);
        self.writer.flush().map_err(failed)
    }

    /// Ends the record with an index of what is in it.
    ///
    /// # Errors
    /// Fails if the writer does.
    pub fn finish(mut self) -> io::Result<W> {
        self.writer.finish().map_err(failed)?;
        let mut to = self.writer.into_inner();
        to.flush()?;
        Ok(to)
    }

    fn report(&mut self, board: usize, at: Moment, report: &Report) -> io::Result<()> {
        for (device, value) in &report.values {
            self.value(board, at, (*device, value), Some(report))?;
        }
        Ok(())
    }

    fn value(
        &mut self,
        board: usize,
        at: Moment,
        (index, value): (usize, &[Scalar]),
        report: Option<&Report>,
    ) -> io::Result<()> {
        let id = self.channels.get(board).and_then(|channels| channels.devices.get(index)).copied();
        let device = self.boards.get(board).and_then(|board| board.devices.get(index));
        let (Some(id), Some(device)) = (id, device) else { return Ok(()) };
        let mut message = std::mem::take(&mut self.message);
        message.clear();
        let shown = elements(device, value, |one| shown(device, one));
        let _ = write!(message, "{{\"value\":{shown},\"raw\":{}", elements(device, value, raw));
        if let Some(stamp) = report.and_then(|report| report.stamp) {
            let _ =
                write!(message, ",\"stamp_us\":{},\"counter\":{}", stamp.time_us, stamp.counter);
        }
        message.push(b'}');
        let latency = report.and_then(|report| report.latency).unwrap_or_default();
        let done = self.put(id, at, latency, &message);
        self.message = message;
        done
    }

    fn json(&mut self, id: u16, at: Moment, value: &Value) -> io::Result<()> {
        self.put(id, at, Duration::ZERO, value.to_string().as_bytes())
    }

    fn put(&mut self, id: u16, at: Moment, latency: Duration, data: &[u8]) -> io::Result<()> {
        let sequence = self.sequences.entry(id).or_default();
        let header = MessageHeader {
            channel_id: id,
            sequence: *sequence,
            log_time: nanoseconds(at.unix),
            publish_time: nanoseconds(at.unix.saturating_sub(latency)),
        };
        *sequence = sequence.wrapping_add(1);
        self.pending += data.len();
        self.writer.write_to_known_channel(&header, data).map_err(failed)
    }

    fn health(&self, board: usize, health: &Health) -> Value {
        let board = self.boards.get(board);
        let devices = health.devices.iter().map(|one| {
            let device =
                board.and_then(|board| board.devices.iter().find(|device| device.id == one.id));
            let age_ms = (one.age_ms != NEVER_MS).then_some(one.age_ms);
            let counts: u32 = one.causes.counts().into_iter().map(u32::from).sum();
            json!({
                "device": device.map(|device| &device.name),
                "status": status(one.status),
                "age_ms": age_ms,
                "failures": counts,
            })
        });
        json!({
            "uptime_ms": health.uptime_ms,
            "reports_sent": health.reports_sent,
            "reports_refused": health.reports_refused,
            "load_percent": (health.load_percent <= 100).then_some(health.load_percent),
            "stack_left_bytes": (health.stack_left_bytes != u16::MAX).then_some(health.stack_left_bytes),
            "devices": devices.collect::<Vec<_>>(),
        })
    }
}

impl Channels {
    fn new<W: Write + Seek>(writer: &mut Writer<W>, board: &Board) -> Result<Self, McapError> {
        let schema = |writer: &mut Writer<W>, name: &str, schema: &Value| {
            writer.add_schema(
                &format!("sensedsl.{}.{name}", board.name),
                JSON_SCHEMA,
                schema.to_string().as_bytes(),
            )
        };
        let mut devices = Vec::with_capacity(board.devices.len());
        for device in &board.devices {
            let schema = schema(writer, &device.name, &value_schema(device, board.schema.stamp))?;
            devices.push(writer.add_channel(
                schema,
                &topic(board, &device.name),
                JSON,
                &about(device),
            )?);
        }
        let open = writer.add_schema(
            "sensedsl.object",
            JSON_SCHEMA,
            open_schema().to_string().as_bytes(),
        )?;
        let none = BTreeMap::new();
        Ok(Self {
            devices,
            health: writer.add_channel(open, &topic(board, HEALTH), JSON, &none)?,
            events: writer.add_channel(open, &topic(board, EVENTS), JSON, &none)?,
            received: writer.add_channel(0, &topic(board, RECEIVED), OCTETS, &none)?,
            sent: writer.add_channel(0, &topic(board, SENT), OCTETS, &none)?,
        })
    }
}

fn failed(error: McapError) -> io::Error {
    if let McapError::Io(error) = error { error } else { io::Error::other(error) }
}

fn nanoseconds(time: Duration) -> u64 {
    u64::try_from(time.as_nanos()).unwrap_or(u64::MAX)
}
