//! Values as they are printed: lines, JSON, CSV, or a table of the latest ones.

use std::time::Duration;

use sensedsl_host::{Board, Device, Overstep, Session};
use sensedsl_wire::{Direction, Health, NEVER_MS, Scalar, ScalarType, Stamp, Status};
use serde_json::{Map, Value, json};

use crate::cli::MonitorFormat;
use crate::commands::table::table;

/// The most characters of a value in the table; arrays can be longer.
const VALUE_CHARS: usize = 40;
/// The head of the CSV.
const CSV_HEAD: &str = "time_s,device,element,raw,value,unit\n";

/// The latest values of a board, and how new ones are printed.
pub(super) struct Show<'b> {
    board: &'b Board,
    format: MonitorFormat,
    latest: Vec<Option<(Duration, Vec<Scalar>)>>,
    counts: Vec<u64>,
    /// The lines of the table that is on the screen.
    lines: usize,
    has_head: bool,
}

impl<'b> Show<'b> {
    pub(super) fn new(board: &'b Board, format: MonitorFormat) -> Self {
        let latest = vec![None; board.devices.len()];
        let counts = vec![0; board.devices.len()];
        Self { board, format, latest, counts, lines: 0, has_head: false }
    }

    /// Takes a value, received or sent, and returns what is printed of it.
    pub(super) fn take(
        &mut self,
        now: Duration,
        index: usize,
        value: Vec<Scalar>,
        stamp: Option<Stamp>,
    ) -> String {
        let Some(device) = self.board.devices.get(index) else { return String::new() };
        let text = match self.format {
            MonitorFormat::Table => String::new(),
            MonitorFormat::Lines => {
                format!(
                    "{:9.3} s  {} = {}{}\n",
                    now.as_secs_f64(),
                    device.name,
                    device.text(&value),
                    mark(device, &value)
                )
            }
            MonitorFormat::Ndjson => {
                format!("{}\n", object(self.board, device, now, &value, stamp))
            }
            MonitorFormat::Csv => {
                let head = if self.has_head { "" } else { CSV_HEAD };
                self.has_head = true;
                format!("{head}{}", rows(device, now, &value))
            }
        };
        if let (Some(latest), Some(count)) =
            (self.latest.get_mut(index), self.counts.get_mut(index))
        {
            *latest = Some((now, value));
            *count += 1;
        }
        text
    }

    /// The table, printed over the previous one. What does not fit the terminal is left out: a line that wraps, or one
    /// above its first row, could not be printed over.
    pub(super) fn refreshed(
        &mut self,
        now: Duration,
        session: &Session<'_>,
        size: Option<(usize, usize)>,
    ) -> String {
        let text = self.table(now, session);
        let lines = fitting(&text, size);
        let up = if self.lines > 0 { format!("\x1b[{}A", self.lines) } else { String::new() };
        self.lines = lines.len();
        let lines: Vec<String> = lines.iter().map(|line| format!("{line}\x1b[K\n")).collect();
        format!("{up}{}", lines.concat())
    }

    /// The whole table, for the end and for pipes.
    pub(super) fn last(&mut self, now: Duration, session: &Session<'_>) -> String {
        let up = if self.lines > 0 { format!("\x1b[{}A\x1b[J", self.lines) } else { String::new() };
        self.lines = 0;
        format!("{up}{}", self.table(now, session))
    }

    /// Something else was printed: the next table begins below it.
    pub(super) fn interrupted(&mut self) {
        self.lines = 0;
    }

    fn table(&self, now: Duration, session: &Session<'_>) -> String {
        let all = self.board.devices.iter().enumerate();
        let rows: Vec<[String; 5]> =
            all.map(|(index, device)| self.cells(index, device, (now, session))).collect();
        let counts = session.counts();
        let lost = if self.board.schema.stamp {
            format!(", {} reports lost", counts.lost)
        } else {
            String::new()
        };
        let head = format!(
            "{} for {:.0} s: {} frames, {} bytes dropped{lost}\n",
            self.board.name,
            now.as_secs_f64(),
            counts.frames,
            counts.dropped_bytes
        );
        format!("{head}{}", table(["Device", ">Value", ">Age", ">Values", ""], &rows))
    }

    fn cells(
        &self,
        index: usize,
        device: &Device,
        (now, session): (Duration, &Session<'_>),
    ) -> [String; 5] {
        let count = self.counts.get(index).copied().unwrap_or_default().to_string();
        let Some((at, value)) = self.latest.get(index).and_then(Option::as_ref) else {
            let none = match device.direction {
                Direction::Sensor => "-",
                Direction::Actuator => "not set",
            };
            return [device.name.clone(), none.to_owned(), String::new(), count, String::new()];
        };
        let mut shown = device.brief(value);
        if shown.chars().count() > VALUE_CHARS {
            shown = shown.chars().take(VALUE_CHARS - 2).chain([' ', '…']).collect();
        }
        let age = now.saturating_sub(*at).as_millis();
        let is_overdue = device.direction == Direction::Sensor && session.is_overdue(index, now);
        let mut marks = mark(device, value).trim().to_owned();
        if is_overdue {
            marks = format!("{marks} overdue").trim().to_owned();
        }
        [device.name.clone(), shown, format!("{age} ms"), count, marks]
    }
}

/// The lines of a text that fit a terminal, each cut to its width; the last one says how many are missing.
fn fitting(text: &str, size: Option<(usize, usize)>) -> Vec<String> {
    let all: Vec<&str> = text.lines().collect();
    let Some((columns, rows)) = size else { return all.into_iter().map(str::to_owned).collect() };
    let cut = |line: &str| line.chars().take(columns.saturating_sub(1)).collect::<String>();
    // The cursor is in the row below the table.
    let room = rows.saturating_sub(1).max(2);
    if all.len() <= room {
        return all.into_iter().map(cut).collect();
    }
    let mut lines: Vec<String> = all.iter().take(room - 1).map(|line| cut(line)).collect();
    let missing = all.len() - lines.len();
    lines.push(cut(&format!(
        "  and {missing} more: make the window higher, or use `--format lines`"
    )));
    lines
}

/// What is said behind a value outside of its limits.
fn mark(device: &Device, value: &[Scalar]) -> String {
    let unit = device.quantity.as_ref().map_or(String::new(), |unit| format!(" {unit}"));
    match device.overstep(value) {
        Some(Overstep::Below(least)) => format!(" (below the minimum of {least}{unit})"),
        Some(Overstep::Above(greatest)) => format!(" (above the maximum of {greatest}{unit})"),
        None => String::new(),
    }
}

/// A raw element in JSON: whole numbers of any size, and what is no number as null.
fn raw(scalar: Scalar) -> Value {
    match scalar {
        Scalar::Bool(flag) => flag.into(),
        Scalar::Unsigned(number) => number.into(),
        Scalar::Signed(number) => number.into(),
        Scalar::Float32(number) => f64::from(number).into(),
        Scalar::Float64(number) => number.into(),
    }
}

/// A shown element in JSON.
fn shown(device: &Device, scalar: Scalar) -> Value {
    if device.value.scalar == ScalarType::Bool { raw(scalar) } else { device.shown(scalar).into() }
}

fn object(
    board: &Board,
    device: &Device,
    now: Duration,
    value: &[Scalar],
    stamp: Option<Stamp>,
) -> Value {
    let one_or_all = |all: Vec<Value>| match (device.value.length, all.as_slice()) {
        (None, [one]) => one.clone(),
        _ => Value::Array(all),
    };
    let mut object = Map::new();
    object.insert("time_s".into(), json!(rounded(now)));
    object.insert("board".into(), json!(board.name));
    object.insert("device".into(), json!(device.name));
    object.insert("raw".into(), one_or_all(value.iter().map(|one| raw(*one)).collect()));
    object
        .insert("value".into(), one_or_all(value.iter().map(|one| shown(device, *one)).collect()));
    object.insert("unit".into(), json!(device.quantity));
    if let Some(Stamp { time_us, counter }) = stamp {
        object.insert("stamp_us".into(), json!(time_us));
        object.insert("counter".into(), json!(counter));
    }
    Value::Object(object)
}

/// Seconds, to the microsecond.
fn rounded(now: Duration) -> f64 {
    (now.as_secs_f64() * 1e6).round() / 1e6
}

fn rows(device: &Device, now: Duration, value: &[Scalar]) -> String {
    let unit = device.quantity.as_deref().unwrap_or_default();
    let quoted = if unit.contains([',', '"']) {
        format!("\"{}\"", unit.replace('"', "\"\""))
    } else {
        unit.to_owned()
    };
    let all = value.iter().enumerate().map(|(element, one)| {
        let shown = shown(device, *one);
        format!("{:.6},{},{element},{one},{shown},{quoted}\n", now.as_secs_f64(), device.name)
    });
    all.collect()
}

/// How a board is, in lines.
pub(super) fn health(board: &Board, health: &Health) -> String {
    let Health { uptime_ms, reports_sent, reports_refused, .. } = health;
    let head = format!(
        "health of {}: up {:.1} s, {reports_sent} reports sent, {reports_refused} refused\n",
        board.name,
        f64::from(*uptime_ms) / 1e3
    );
    let rows: Vec<[String; 4]> = health
        .devices
        .iter()
        .map(|one| {
            let device = board.devices.iter().find(|device| device.id == one.id);
            let name = device.map_or(String::new(), |device| device.name.clone());
            let age =
                if one.age_ms == NEVER_MS { "-".to_owned() } else { format!("{} ms", one.age_ms) };
            [name, status(one.status).to_owned(), age, causes(one.causes.counts())]
        })
        .collect();
    format!("{head}{}", table(["Device", "Status", ">Age", "Failures"], &rows))
}

pub(super) fn status(status: Status) -> &'static str {
    match status {
        Status::NeverRead => "never read",
        Status::Good => "good",
        Status::Stale => "stale",
        Status::Failed => "failed",
        Status::Invalid => "invalid",
        Status::Other(_) => "unknown",
    }
}

/// How often a device failed, by cause.
pub(super) fn causes(counts: [u16; 6]) -> String {
    let words = [
        "not acknowledged",
        "bus errors",
        "arbitration lost",
        "timed out",
        "wrong checksums",
        "invalid",
    ];
    let some = counts.iter().zip(words).filter(|(count, _)| **count > 0);
    some.map(|(count, word)| format!("{count} {word}")).collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_stays_in_its_terminal() {
        let text = "head\nabcdef\nb\nc\n";
        assert_eq!(fitting(text, None), ["head", "abcdef", "b", "c"]);
        assert_eq!(fitting(text, Some((5, 5))), ["head", "abcd", "b", "c"]);
        let cut = fitting(text, Some((20, 4)));
        assert_eq!(cut, ["head", "abcdef", "  and 2 more: make "]);
        assert_eq!(fitting(text, Some((1, 1))).len(), 2);
    }
}
