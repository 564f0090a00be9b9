//! What the subscriber got in, what that says out: which values are missing or wrong, and how late they came.
//!
//! Nothing here asks a monitor: the worlds say what each board measures at which time, and the board's own stamp says
//! when that was.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{BufRead as _, BufReader};

use anyhow::{Context as _, Result};
use serde::Deserialize;

use super::design::{Course, Group};
use super::run::Ran;

/// How long before the end the last value of a device may have come, beside two of its periods.
const SILENT_NS: u64 = 1_500_000_000;

/// A sample's text, as far as it counts here.
#[derive(Deserialize)]
struct Sample {
    time: f64,
    value: f64,
    stamp_us: f64,
}

/// A device, and what is known of it.
struct Device {
    course: Course,
    is_killed: bool,
    last: Option<(f64, f64)>,
    came_ns: u64,
}

/// What came of all values.
#[derive(Debug, Default)]
pub(super) struct Verdict {
    pub(super) boards: usize,
    /// Values while it was measured.
    pub(super) values: usize,
    /// Values of the whole run that did not come, although later ones of the device did.
    pub(super) missing: u64,
    /// Values that the world does not say, twice the same, out of order, or of a key that no board has.
    pub(super) wrong: u64,
    /// The first of them.
    pub(super) first: Option<String>,
    /// Devices of boards that were not killed of which nothing came at the end.
    pub(super) silent: usize,
    /// The milliseconds from each value's being made to its arrival, in their order, while it was measured.
    pub(super) latencies_ms: Vec<f64>,
    /// Reports that monitors did not get, or could not hand on.
    pub(super) not_taken: u64,
}

impl Verdict {
    /// How late the latest of such a share of values came.
    pub(super) fn latency_ms(&self, share: f64) -> f64 {
        let last = self.latencies_ms.len().saturating_sub(1);
        self.latencies_ms.get((last as f64 * share) as usize).copied().unwrap_or_default()
    }

    fn wrong(&mut self, what: String) {
        self.wrong += 1;
        let _ = self.first.get_or_insert(what);
    }

    fn take(&mut self, device: &mut Device, key: &str, sample: &Sample, rate_hz: f64) {
        let (at_s, value) = (sample.stamp_us / 1e6, sample.value);
        if !device.course.is_at(value, at_s, rate_hz) {
            self.wrong(format!("{key} is {value} at {at_s} s"));
        }
        if let Some((last_s, last)) = device.last.replace((at_s, value)) {
            let steps = match device.course {
                Course::Counts => value - last,
                Course::Moves { .. } => ((at_s - last_s) * rate_hz).round(),
            };
            if steps < 1.0 {
                self.wrong(format!("{key} at {at_s} s comes after {last_s} s"));
            } else {
                self.missing += steps as u64 - 1;
            }
        }
    }
}

/// Judges a run.
pub(super) fn verdict(ran: &Ran, groups: &[Group], rate_hz: u32) -> Result<Verdict> {
    let mut devices: BTreeMap<String, Device> = BTreeMap::new();
    for (at, group) in groups.iter().enumerate() {
        for (key, course) in &group.keys {
            let is_killed = at + 1 == groups.len();
            let device = Device { course: *course, is_killed, last: None, came_ns: 0 };
            let _ = devices.insert(format!("{}/{key}", group.name), device);
        }
    }
    let mut verdict = Verdict::default();
    let (begin, end) = ran.measured_ns;
    for line in BufReader::new(File::open(&ran.samples)?).lines() {
        let line = line?;
        let mut parts = line.splitn(3, '\t');
        let mut part = || parts.next().context("a sample without its parts");
        let (at_ns, key, text): (u64, _, _) = (part()?.parse()?, part()?, part()?);
        if key.contains("/link/") {
            continue;
        }
        let (Some(device), Ok(sample)) =
            (devices.get_mut(key), serde_json::from_str::<Sample>(text))
        else {
            verdict.wrong(format!("{key} carries {text}"));
            continue;
        };
        device.came_ns = at_ns;
        verdict.take(device, key, &sample, rate_hz.into());
        if (begin..end).contains(&at_ns) {
            verdict.values += 1;
            verdict.latencies_ms.push(at_ns as f64 / 1e6 - sample.time * 1e3);
        }
    }
    verdict.latencies_ms.sort_by(f64::total_cmp);
    let limit_ns = SILENT_NS + 2_000_000_000 / u64::from(rate_hz.max(1));
    let is_silent = |one: &&Device| !one.is_killed && one.came_ns + limit_ns < ran.ended_ns;
    verdict.silent = devices.values().filter(is_silent).count();
    // Keys are in order, so those of a board are neighbours.
    let mut seen: Vec<&str> = devices
        .iter()
        .filter(|(_, one)| one.last.is_some())
        .filter_map(|(key, _)| Some(key.rsplit_once('/')?.0))
        .collect();
    seen.dedup();
    verdict.boards = seen.len();
    verdict.not_taken = ran.logs.iter().flat_map(|log| log.lines()).map(told).sum();
    Ok(verdict)
}

/// What a line of a monitor's end says of reports that it did not get or hand on.
fn told(line: &str) -> u64 {
    ["reports lost", "reports did not fit"]
        .into_iter()
        .find_map(|what| {
            let (before, _) = line.split_once(what)?;
            before.split_whitespace().next_back()?.parse::<u64>().ok()
        })
        .unwrap_or_default()
}
