//! What a host has seen since it was last asked, for a page.

use std::collections::BTreeMap;
use std::time::Duration;

use sensedsl_host::{
    Board, Event, Faults, Session, State, causes, keep_alive, reset_cause, status,
};
use sensedsl_wire::{Health, NEVER_MS, Scalar};
use serde_json::{Value, json};

/// How often a board is asked how it is.
pub(super) const HEALTH_EVERY: Duration = Duration::from_secs(5);
/// The most values and notes that wait for a page that does not ask.
const WAITING_MAX: usize = 100_000;

/// Collects what a session tells.
pub(super) struct Watch {
    board: &'static Board,
    values: Vec<Value>,
    /// Values that a page did not ask for in time.
    left_out: u64,
    notes: Vec<Value>,
    health: Option<Value>,
    faults: Faults,
    /// The frames of what was set, by the actuator's place.
    held: BTreeMap<usize, Vec<u8>>,
    sent: Duration,
    is_just_matched: bool,
}

impl Watch {
    pub(super) fn new(board: &'static Board) -> Self {
        Self {
            board,
            values: Vec::new(),
            left_out: 0,
            notes: Vec::new(),
            health: None,
            faults: Faults::new(board),
            held: BTreeMap::new(),
            sent: Duration::ZERO,
            is_just_matched: false,
        }
    }

    /// The link is another one: what waited for the old one is kept, so that nothing that was seen is lost.
    pub(super) fn reopened(&mut self) {
        self.faults = Faults::new(self.board);
        self.is_just_matched = false;
    }

    /// Remembers what was set, to set it again on a board that comes back.
    pub(super) fn hold(&mut self, device: usize, frame: Vec<u8>) {
        self.held.insert(device, frame);
    }

    /// All that was set.
    pub(super) fn held(&self) -> impl Iterator<Item = u8> {
        self.held.values().flatten().copied()
    }

    /// Whether the board has said who it is since the last call.
    pub(super) fn has_just_matched(&mut self) -> bool {
        std::mem::take(&mut self.is_just_matched)
    }

    /// A question that keeps actuators from their failsafe while something was set.
    pub(super) fn keep_alive(
        &mut self,
        session: &Session<'_>,
        now: Duration,
        is_sent: bool,
    ) -> Vec<u8> {
        if is_sent {
            self.sent = now;
            return Vec::new();
        }
        if self.held.is_empty() {
            return Vec::new();
        }
        let due = keep_alive(self.board, session.state(), now.saturating_sub(self.sent));
        if due.is_some() {
            self.sent = now;
        }
        due.unwrap_or_default()
    }

    /// Takes what a session tells.
    pub(super) fn take(&mut self, event: Event, now: Duration) {
        let name = |index: usize| self.board.devices.get(index).map_or("", |one| one.name.as_str());
        match event {
            Event::Values(_, values) => self.report(&values, now),
            Event::Matched => {
                self.is_just_matched = true;
                self.note("info", format!("{}: firmware and design agree", self.board.name));
            }
            Event::Unverified => {}
            Event::Unanswered => self.note(
                "warning",
                format!("{} does not answer: is it this board, with its firmware?", self.board.name),
            ),
            Event::Silent(time) => {
                let text =
                    format!("{} says nothing for {}; asking it again", self.board.name, span(time));
                self.note("warning", text);
            }
            Event::Overdue(index, time) => {
                let text = format!("{}: no value for {}", name(index), span(time));
                self.note("warning", text);
            }
            Event::Again(index, time) => {
                let text = format!("{}: values again after {}", name(index), span(time));
                self.note("info", text);
            }
            Event::Health(health) => self.take_health(&health),
            Event::OtherHealth(version) => self.note(
                "warning",
                format!(
                    "{} tells its health in version {version}, which is not known here: flash the board again",
                    self.board.name
                ),
            ),
            Event::Other { hash, differences } => {
                let head = format!(
                    "this is another board, or it has other firmware (hash {hash:#010x}): flash the firmware of this design, or open the design of this board"
                );
                self.note("error", head);
                differences.into_iter().for_each(|one| self.note("error", one));
            }
        }
    }

    fn report(&mut self, values: &[(usize, Vec<Scalar>)], now: Duration) {
        for (index, value) in values {
            let Some(device) = self.board.devices.get(*index) else { continue };
            if self.values.len() >= WAITING_MAX {
                self.left_out += 1;
                continue;
            }
            // A number that is none is null in JSON; a page shows the text.
            let numbers: Vec<Value> =
                value.iter().map(|raw| Value::from(device.shown(*raw))).collect();
            self.values.push(json!([
                now.as_millis().min(u128::from(u64::MAX)) as u64,
                index,
                numbers,
                device.brief(value),
                value.iter().map(|one| raw(*one)).collect::<Vec<_>>(),
            ]));
        }
    }

    fn take_health(&mut self, health: &Health) {
        let all = health.devices.iter().zip(&self.board.devices);
        let devices: Vec<Value> = all
            .map(|(one, device)| {
                json!({
                    "name": device.name,
                    "status": status(one.status),
                    "age_ms": (one.age_ms != NEVER_MS).then_some(one.age_ms),
                    "causes": causes(one.causes.counts()),
                })
            })
            .collect();
        self.health = Some(json!({
            "uptime_s": f64::from(health.uptime_ms) / 1e3,
            "reset_cause": reset_cause(health.reset_cause),
            "reports_sent": health.reports_sent,
            "reports_refused": health.reports_refused,
            "devices": devices,
        }));
        for fault in self.faults.news(self.board, health) {
            self.note("warning", fault);
        }
    }

    pub(super) fn note(&mut self, level: &str, text: impl Into<Value>) {
        if self.notes.len() < WAITING_MAX {
            self.notes.push(json!({ "level": level, "text": text.into() }));
        }
    }

    /// What was seen since the last call.
    pub(super) fn seen(&mut self, session: &Session<'_>, now: Duration) -> Value {
        let state = match session.state() {
            State::Asking => "asking",
            State::Matched => "matched",
            State::Playing => "playing",
            State::Comparing => "comparing",
            State::Refused => "refused",
        };
        let counts = session.counts();
        let left_out = std::mem::take(&mut self.left_out);
        if left_out > 0 {
            let text = format!("the page was too slow: {left_out} values were left out");
            self.note("warning", text);
        }
        json!({
            "now_ms": now.as_millis().min(u128::from(u64::MAX)) as u64,
            "state": state,
            "values": std::mem::take(&mut self.values),
            "notes": std::mem::take(&mut self.notes),
            "health": self.health.take(),
            "counts": {
                "bytes": counts.bytes,
                "frames": counts.frames,
                "dropped_bytes": counts.dropped_bytes,
                "withheld": counts.withheld,
                "lost": counts.lost,
            },
        })
    }
}

/// What the board sent, as the monitor writes it.
fn raw(scalar: Scalar) -> Value {
    match scalar {
        Scalar::Bool(flag) => flag.into(),
        Scalar::Unsigned(number) => number.into(),
        Scalar::Signed(number) => number.into(),
        Scalar::Float32(number) => number.into(),
        Scalar::Float64(number) => number.into(),
    }
}

/// A span of time for people.
fn span(time: Duration) -> String {
    format!("{:.1} s", time.as_secs_f64())
}
