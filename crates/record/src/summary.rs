//! What a record comes to: for each device how many values, how regularly and how late they came, and within what
//! limits; for each board what was lost.

use std::io::Read;
use std::time::Duration;

use sensedsl_host::{
    Board, BoardClock, ClockError, Counts, Device, DeviceStats, Event, Histogram, Moment, News,
    Overstep, Session, What,
};
use sensedsl_wire::{Direction, Health, Scalar, Stamp};

use crate::convert::{ConvertError, Part, check_names};
use crate::read::{Ending, Entry, Past, RecordReader};
use crate::series::Series;

/// What a record comes to.
pub struct Summary {
    /// How it ends.
    pub ending: Ending,
    /// When it began, since 1970.
    pub began: Duration,
    /// From its begin to its last entry.
    pub lasted: Duration,
    /// Its boards.
    pub boards: Vec<BoardSummary>,
}

/// What became of a board.
pub struct BoardSummary {
    /// Its name.
    pub name: String,
    /// Whether its reports have stamps, so that lost ones are counted and latencies known.
    pub has_stamps: bool,
    /// What came over the link.
    pub counts: Counts,
    /// How well its clock is known.
    pub clock: Option<ClockError>,
    /// When it was not there: from, until, and why.
    pub absences: Vec<(Duration, Option<Duration>, String)>,
    /// What it said last of itself.
    pub health: Option<Health>,
    /// Its devices.
    pub devices: Vec<DeviceSummary>,
}

/// What became of a device.
pub struct DeviceSummary {
    /// The device.
    pub device: Device,
    /// How regularly and how late its values came.
    pub stats: DeviceStats,
    /// How many values were below its least or above its greatest.
    pub overstepped: u64,
    /// What was shown of each element.
    pub elements: Vec<Series>,
}

/// Reads a part of a record.
///
/// # Errors
/// Fails if the record cannot be read, or does not have what the part names.
pub fn summary<R: Read>(mut reader: RecordReader<R>, part: &Part) -> Result<Summary, ConvertError> {
    let boards = reader.boards().to_vec();
    check_names(&boards, part)?;
    let wanted = |board: &&Board| part.board.as_ref().is_none_or(|name| *name == board.name);
    let mut tallies: Vec<Option<Tally<'_>>> =
        boards.iter().map(|board| Some(board).filter(wanted).map(Tally::new)).collect();
    let began = reader.begin().unix;
    let mut lasted = Duration::ZERO;
    while let Some(entry) = reader.next_entry().map_err(ConvertError::Read)? {
        if part.until.is_some_and(|until| entry.at.run >= until) {
            break;
        }
        lasted = entry.at.run;
        if part.from.is_some_and(|from| entry.at.run < from) {
            continue;
        }
        if let Some(Some(tally)) = tallies.get_mut(entry.board) {
            tally.take(&entry);
        }
    }
    let mut boards: Vec<BoardSummary> = tallies.into_iter().flatten().map(Tally::done).collect();
    for board in &mut boards {
        let names = &part.devices;
        board.devices.retain(|one| names.is_empty() || names.contains(&one.device.name));
    }
    Ok(Summary { ending: reader.ending().unwrap_or(Ending::Whole), began, lasted, boards })
}

/// Sums up a run while it lasts.
pub struct Summing<'b> {
    began: Moment,
    lasted: Duration,
    tallies: Vec<Tally<'b>>,
}

impl<'b> Summing<'b> {
    /// Begins with the boards that are watched, in their order.
    pub fn new(boards: impl IntoIterator<Item = &'b Board>, began: Moment) -> Self {
        let tallies = boards.into_iter().map(Tally::new).collect();
        Self { began, lasted: Duration::ZERO, tallies }
    }

    /// Takes what happened.
    pub fn take(&mut self, news: &News<'_>) {
        self.lasted = self.lasted.max(news.at.run);
        if let Some(tally) = self.tallies.get_mut(news.board) {
            tally.hear(news);
        }
    }

    /// What it came to.
    #[must_use]
    pub fn done(self) -> Summary {
        let boards = self.tallies.into_iter().map(Tally::done).collect();
        Summary { ending: Ending::Whole, began: self.began.unix, lasted: self.lasted, boards }
    }
}

/// A board that is being counted.
struct Tally<'b> {
    board: &'b Board,
    session: Session<'b>,
    clock: BoardClock,
    before: Counts,
    stamped: Option<(Duration, Stamp)>,
    done: BoardSummary,
}

impl<'b> Tally<'b> {
    fn new(board: &'b Board) -> Self {
        let device = |device: &Device| DeviceSummary {
            device: device.clone(),
            stats: DeviceStats::default(),
            overstepped: 0,
            elements: vec![Series::default(); device.value.count()],
        };
        let done = BoardSummary {
            name: board.name.clone(),
            has_stamps: board.schema.stamp,
            counts: Counts::default(),
            clock: None,
            absences: Vec::new(),
            health: None,
            devices: board.devices.iter().map(device).collect(),
        };
        let (session, clock) = (Session::recording(board), BoardClock::default());
        Self { board, session, clock, before: Counts::default(), stamped: None, done }
    }

    fn take(&mut self, entry: &Entry) {
        let now = entry.at.run;
        match &entry.what {
            Past::Received(bytes) => self.received(bytes, now),
            Past::Sent(_) => self.clock.asked(now),
            Past::Value { device, value, stamp, latency } => {
                self.value((*device, value), *stamp, *latency, now);
            }
            Past::Event(event) => match event.get("why").and_then(|why| why.as_str()) {
                Some(why) => self.away(why, now),
                None => self.back(now),
            },
            // What it says is among the bytes, too.
            Past::Health(_) => {}
        }
    }

    fn hear(&mut self, news: &News<'_>) {
        let now = news.at.run;
        match news.what {
            What::Received(bytes) => self.received(bytes, now),
            What::Sent(_) => self.clock.asked(now),
            What::Report(report) => {
                for (device, value) in &report.values {
                    self.value((*device, value), report.stamp, report.latency, now);
                }
            }
            What::Command { device, value } => self.value((device, value), None, None, now),
            What::Offline(why) => self.away(why, now),
            What::Online => self.back(now),
            What::Health(_) => {}
        }
    }

    fn away(&mut self, why: &str, now: Duration) {
        self.interrupt();
        self.done.absences.push((now, None, why.to_owned()));
    }

    fn back(&mut self, now: Duration) {
        if let Some((_, until @ None, _)) = self.done.absences.last_mut() {
            *until = Some(now);
        }
    }

    fn interrupt(&mut self) {
        self.before += self.session.counts();
        self.session = Session::recording(self.board);
        self.clock.restart();
        self.done.devices.iter_mut().for_each(|device| device.stats.interrupt());
    }

    fn received(&mut self, bytes: &[u8], now: Duration) {
        let mut events = Vec::new();
        self.session.feed(bytes, now, &mut |event| events.push(event));
        for event in events {
            match event {
                Event::Matched => self.clock.answered(now),
                Event::Health(health) => {
                    self.clock.answered(now);
                    self.done.health = Some(health);
                }
                Event::Unverified
                | Event::Other { .. }
                | Event::Values(..)
                | Event::OtherHealth(_)
                | Event::Unanswered
                | Event::Silent(_)
                | Event::Overdue(..)
                | Event::Again(..) => {}
            }
        }
    }

    fn value(
        &mut self,
        (index, value): (usize, &[Scalar]),
        stamp: Option<Stamp>,
        latency: Option<Duration>,
        now: Duration,
    ) {
        // A report has one stamp, however many values.
        if let Some(stamp) = stamp.filter(|stamp| self.stamped != Some((now, *stamp))) {
            self.clock.stamped(stamp.time_us, now);
            self.stamped = Some((now, stamp));
        }
        let Some(one) = self.done.devices.get_mut(index) else { return };
        let is_sensor = one.device.direction == Direction::Sensor;
        let cycle = one.device.cycle_ms.filter(|_| is_sensor);
        let cycle = cycle.map(|cycle_ms| Duration::from_millis(cycle_ms.into()));
        one.stats.add(now, latency, stamp.map(|stamp| stamp.time_us), cycle);
        let is_outside =
            matches!(one.device.overstep(value), Some(Overstep::Below(_) | Overstep::Above(_)));
        one.overstepped += u64::from(is_outside);
        for (series, raw) in one.elements.iter_mut().zip(value) {
            series.add(now, one.device.shown(*raw));
        }
    }

    fn done(self) -> BoardSummary {
        let mut counts = self.session.counts();
        counts += self.before;
        BoardSummary { counts, clock: self.clock.error(), ..self.done }
    }
}

/// The heads of the table of devices.
pub const HEADS: [&str; 11] = [
    "Device", "Values", "Rate", "Every", "Jitter", "Latency", "99 %", "Missing", "Least", "Mean",
    "Most",
];

impl BoardSummary {
    /// How long it was watched, and what came.
    #[must_use]
    pub fn head(&self, lasted: Duration) -> String {
        let Counts { frames, dropped_bytes, lost, .. } = self.counts;
        let lost = if self.has_stamps { format!(", {lost} reports lost") } else { String::new() };
        format!(
            "{:.1} s, {frames} frames, {dropped_bytes} bytes dropped{lost}",
            lasted.as_secs_f64()
        )
    }

    /// What else is to be known.
    #[must_use]
    pub fn notes(&self) -> Vec<String> {
        let mut notes = Vec::new();
        if let Some(ClockError { within, drift_ppm }) = self.clock.filter(|_| self.has_stamps) {
            let drift = drift_ppm
                .map_or(String::new(), |ppm| format!(", the board's clock is {}", off(ppm)));
            notes.push(format!("latencies are known within {}{drift}", milliseconds(within)));
        }
        for (from, until, why) in &self.absences {
            let until =
                until.map_or("the end".to_owned(), |until| format!("{:.1} s", until.as_secs_f64()));
            notes.push(format!("away from {:.1} s to {until}: {why}", from.as_secs_f64()));
        }
        if let Some(health) = &self.health {
            let (sent, refused) = (health.reports_sent, health.reports_refused);
            notes.push(format!(
                "{:.2} s after it had started, the board had sent {sent} reports and its link had refused \
                 {refused}",
                f64::from(health.uptime_ms) / 1e3
            ));
        }
        notes
    }
}

fn off(ppm: f64) -> String {
    let side = if ppm < 0.0 { "slow" } else { "fast" };
    format!("{:.0} ppm {side}", ppm.abs())
}

/// A duration with three digits that count.
fn milliseconds(time: Duration) -> String {
    let ms = time.as_secs_f64() * 1e3;
    let decimals = if ms < 10.0 { 2 } else { usize::from(ms < 100.0) };
    format!("{ms:.decimals$} ms")
}

impl DeviceSummary {
    /// A row for each element; what all elements have in common stands in the first one.
    #[must_use]
    pub fn rows(&self, lasted: Duration) -> Vec<[String; 11]> {
        let rows = self.elements.iter().enumerate().map(|(element, series)| {
            let [least, mean, most] =
                series.numbers().map(|number| number.map_or(String::new(), |n| self.number(n)));
            let name = match self.device.value.length {
                Some(_) => format!("{}[{element}]", self.device.name),
                None => self.device.name.clone(),
            };
            let [values, rate, every, jitter, latency, late, missing] =
                if element == 0 { self.common(lasted) } else { Default::default() };
            [name, values, rate, every, jitter, latency, late, missing, least, mean, most]
        });
        rows.collect()
    }

    fn common(&self, lasted: Duration) -> [String; 7] {
        let stats = &self.stats;
        let time = |time: Option<Duration>| time.map_or(String::new(), milliseconds);
        let rate_hz = stats.count() as f64 / lasted.as_secs_f64().max(1e-3);
        let is_sensor = self.device.direction == Direction::Sensor;
        let rate = if is_sensor { format!("{rate_hz:.1} Hz") } else { String::new() };
        let intervals = Some(stats.intervals()).filter(|_| is_sensor);
        [
            stats.count().to_string(),
            rate,
            time(intervals.and_then(Histogram::mean)),
            time(intervals.and_then(Histogram::deviation)),
            time(stats.latencies().quantile(0.5)),
            time(stats.latencies().quantile(0.99)),
            if self.device.cycle_ms.is_some() && is_sensor {
                stats.missing().to_string()
            } else {
                String::new()
            },
        ]
    }

    /// A shown number in its unit, with as many digits as a plot could tell.
    pub(crate) fn number(&self, number: f64) -> String {
        let magnitude = number.abs().max(1e-9).log10().floor();
        let decimals = (4.0 - magnitude).clamp(0.0, 6.0) as usize;
        let text = format!("{number:.decimals$}");
        let text = if text.contains('.') {
            text.trim_end_matches('0').trim_end_matches('.')
        } else {
            &text
        };
        let unit = self.device.quantity.as_ref().map_or(String::new(), |unit| format!(" {unit}"));
        format!("{text}{unit}")
    }
}
