//! Tests of designs: a board that runs in a world under a host in, the signals of its run and the verdict on each rule
//! out.
//!
//! [`Trial`] is the host of one board: it asks for the board's identity, sets what the test sets and what the world's
//! commands say, keeps speaking so that no actuator falls back, and keeps what it is told. A design may have several
//! boards; each runs by itself, and all of them write into one [`Recording`]. [`judge`] holds the recording to the rules.
//!
//! What counts is what a host knows: a sensor has the value of its last report, from the moment at which the report
//! arrived. Of an actuator it is the value that the board has applied, whether the host, a controller or a failsafe set
//! it.

mod edges;
mod verdict;

use std::collections::BTreeMap;

use sensedsl_host::Scale;
use sensedsl_job::BoardJob;
use sensedsl_model::design::{SignalOf, Test};
use sensedsl_rules::{Signal, Trace};
use sensedsl_wire::{
    Decoder, Direction, Event, Scalar, encode_health_request, encode_hello_request, encode_report,
};

use crate::commands::Command;
use crate::soft::SoftBoard;
use crate::truth::{real, scalar, scale_of};
use crate::world::{Fault, World};
pub use verdict::{Judged, Moment, RuleVerdict, judge};

const MS: u64 = 1_000_000;
/// How often the host asks for the board's identity until it answers.
const ASK_NS: u64 = 500 * MS;
/// How often the host asks for the states of devices, where a rule is about one.
const HEALTH_NS: u64 = 100 * MS;
/// The longest that the host is silent.
const SPEAK_NS: u64 = 100 * MS;

/// The signals of a run, by the numbers that the rules of its test name.
#[derive(Clone, Debug, PartialEq)]
pub struct Recording {
    /// In the unit of computation.
    pub trace: Trace,
}

impl Recording {
    /// Nothing was heard yet of a test's signals.
    #[must_use]
    pub fn new(test: &Test) -> Self {
        let signals = vec![Signal::default(); test.signals.len()];
        Self { trace: Trace { signals, end_ns: test.lasts_ns } }
    }

    /// Takes a value from a moment on, unless it has that value already.
    fn take(&mut self, number: usize, at_ns: u64, value: f64) {
        let Some(signal) = self.trace.signals.get_mut(number) else { return };
        let is_new = signal.samples.last().is_none_or(|last| last.1.to_bits() != value.to_bits());
        if is_new {
            signal.samples.push((at_ns, value));
        }
    }

    /// Takes the value that a signal has once more, so that an edge before it has passed.
    fn repeat(&mut self, number: usize, at_ns: u64) {
        let Some(signal) = self.trace.signals.get_mut(number) else { return };
        let last = signal.samples.last().copied();
        signal.samples.extend(last.filter(|last| last.0 < at_ns).map(|last| (at_ns, last.1)));
    }
}

/// The faults of a test beside those of its world, as far as they are of a board or its devices.
pub fn add_faults(world: &mut World, test: &Test, job: &BoardJob<'_>) {
    let is_own = |device| job.devices.iter().any(|one| one.index == device);
    let own = test.faults.iter().filter(|fault| fault.device.is_none_or(is_own));
    world.faults.extend(own.map(|fault| Fault {
        kind: fault.kind,
        device: fault.device,
        at_ns: fault.at_ns,
        until_ns: fault.at_ns.saturating_add(fault.lasts_ns),
    }));
    world.faults.sort_by_key(|fault| fault.at_ns);
}

/// What a signal of the test is on this board.
struct Watched {
    /// Its number.
    number: usize,
    of: SignalOf,
    /// The device's place in the schema.
    index: usize,
    id: u8,
    is_sensor: bool,
    /// Whether a rule asks when something of it rises: that holds until the next sample, so there is one a millisecond.
    has_edges: bool,
    scale: Scale,
}

/// The host of a board in a test.
pub struct Trial<'a> {
    job: &'a BoardJob<'a>,
    test: &'a Test,
    decoder: Decoder<'a>,
    watched: Vec<Watched>,
    /// What is to be set, the next one last.
    owed: Vec<Command>,
    is_known: bool,
    has_health: bool,
    spoke_ns: u64,
    speaks_ns: u64,
    /// When the last value of each sensor came, by identifier.
    came_ns: BTreeMap<u8, u64>,
}

impl<'a> Trial<'a> {
    /// A host that also sends the commands of the world.
    #[must_use]
    pub fn new(job: &'a BoardJob<'a>, test: &'a Test, of_world: &[Command]) -> Self {
        let edges = edges::signals(test);
        let watched: Vec<Watched> = (0..)
            .zip(&test.signals)
            .filter_map(|(number, signal)| {
                let index = job.devices.iter().position(|one| one.index == signal.device)?;
                let device = job.devices.get(index)?.device;
                let is_sensor = device.direction == Direction::Sensor;
                let (id, scale) = (device.id.value, scale_of(&device.shown));
                let has_edges = edges.contains(&number);
                Some(Watched { number, of: signal.of, index, id, is_sensor, has_edges, scale })
            })
            .collect();
        let mut owed: Vec<Command> = test
            .sets
            .iter()
            .filter_map(|set| {
                let device = job.devices.iter().find(|one| one.index == set.device)?.device;
                let value = device.value.value;
                let value = vec![scalar(value.scalar, set.raw); value.count()];
                Some(Command { device: set.device, at_ns: set.at_ns, value })
            })
            .chain(of_world.iter().cloned())
            .collect();
        owed.sort_by_key(|one| std::cmp::Reverse(one.at_ns));
        let silence_ns = job.board.link.silence_ms.map(|ms| MS * u64::from(ms) / 3);
        Self {
            job,
            test,
            decoder: Decoder::new(&job.schema, Direction::Sensor),
            has_health: watched.iter().any(|one| one.of == SignalOf::Health),
            watched,
            owed,
            is_known: false,
            spoke_ns: 0,
            speaks_ns: silence_ns.map_or(u64::MAX, |ns| ns.min(SPEAK_NS)),
            came_ns: BTreeMap::new(),
        }
    }

    /// Runs a board to the end of the test. Returns when and why the code of its controllers has stopped.
    pub fn run(
        mut self,
        board: &mut SoftBoard,
        recording: &mut Recording,
    ) -> Option<(u64, String)> {
        board.link_open(true);
        while board.now_ns() < self.test.lasts_ns {
            let bytes = self.to_send(board.now_ns());
            board.link_write(&bytes);
            let next_ns = board.now_ns() + MS;
            board.run_until(next_ns);
            let bytes = board.link_read();
            self.hear(next_ns, &bytes, recording);
            self.see(next_ns, board, recording);
            if let Some(ended) = board.code_ended() {
                return Some(ended);
            }
        }
        None
    }

    /// What the host sends in this millisecond.
    fn to_send(&mut self, now_ns: u64) -> Vec<u8> {
        let mut bytes = Vec::new();
        if !self.is_known {
            return if now_ns.is_multiple_of(ASK_NS) {
                encode_hello_request(&self.job.schema)
            } else {
                bytes
            };
        }
        // Values that are set at one moment share a frame; of two for one device the later one counts.
        let mut values: BTreeMap<u8, Vec<Scalar>> = BTreeMap::new();
        while let Some(one) = self.owed.pop_if(|one| one.at_ns <= now_ns) {
            let device = self.job.devices.iter().find(|device| device.index == one.device);
            values.extend(device.map(|device| (device.device.id.value, one.value)));
        }
        if !values.is_empty() {
            let values: Vec<(u8, Vec<Scalar>)> = values.into_iter().collect();
            let frame = encode_report(&self.job.schema, Direction::Actuator, &values);
            bytes.extend(frame.unwrap_or_default());
        }
        if self.has_health && now_ns.is_multiple_of(HEALTH_NS) {
            bytes.extend(encode_health_request(&self.job.schema));
        }
        if bytes.is_empty() && now_ns.saturating_sub(self.spoke_ns) >= self.speaks_ns {
            bytes = encode_hello_request(&self.job.schema);
        }
        if !bytes.is_empty() {
            self.spoke_ns = now_ns;
        }
        bytes
    }

    /// Takes what the board has sent.
    fn hear(&mut self, now_ns: u64, bytes: &[u8], recording: &mut Recording) {
        let hash = self.job.schema.hash();
        let (is_known, came_ns) = (&mut self.is_known, &mut self.came_ns);
        let (watched, test) = (&self.watched, self.test);
        self.decoder.feed(bytes, |event| match event {
            Event::Report(_, values) => {
                for (id, value) in &values {
                    came_ns.insert(*id, now_ns);
                    for one in watched.iter().filter(|one| one.is_sensor && one.id == *id) {
                        take_value(one, value, now_ns, test, recording);
                    }
                }
            }
            Event::Hello(answered) => *is_known |= answered == hash,
            Event::Health(health) => {
                for device in &health.devices {
                    let is_it = |one: &&Watched| one.of == SignalOf::Health && one.id == device.id;
                    for one in watched.iter().filter(is_it) {
                        recording.take(one.number, now_ns, f64::from(device.status.code()));
                    }
                }
            }
            Event::OtherHealth(_) | Event::HelloRequest | Event::HealthRequest => {}
        });
    }

    /// The value that the board has applied to an actuator; empty until it has one.
    fn applied(&self, one: &Watched, board: &SoftBoard) -> Vec<Scalar> {
        let item = self.job.schema.items.get(one.index);
        let Some((item, bytes)) = item.zip(board.applied(one.index)) else { return Vec::new() };
        let scalar = item.value.scalar;
        let elements = bytes.chunks_exact(scalar.size_bytes());
        elements.filter_map(|one| scalar.read(one)).collect()
    }

    /// Looks at what the board has applied, and at the clock.
    fn see(&self, now_ns: u64, board: &SoftBoard, recording: &mut Recording) {
        for one in &self.watched {
            match one.of {
                SignalOf::Age => {
                    let since_ns = self.came_ns.get(&one.id).copied().unwrap_or(0);
                    let age_ms = crate::arith::number((now_ns - since_ns) / MS);
                    if let Some(signal) = self.test.signals.get(one.number) {
                        recording.take(one.number, now_ns, signal.unit.computed(age_ms));
                    }
                }
                SignalOf::Value(_) if !one.is_sensor => {
                    let value = self.applied(one, board);
                    take_value(one, &value, now_ns, self.test, recording);
                }
                SignalOf::Value(_) | SignalOf::Health => {}
            }
            if one.has_edges {
                recording.repeat(one.number, now_ns);
            }
        }
    }
}

fn take_value(
    one: &Watched,
    value: &[Scalar],
    now_ns: u64,
    test: &Test,
    recording: &mut Recording,
) {
    let SignalOf::Value(element) = one.of else { return };
    let (Some(raw), Some(signal)) = (value.get(element), test.signals.get(one.number)) else {
        return;
    };
    recording.take(one.number, now_ns, signal.unit.computed(one.scale.shown(real(*raw))));
}

#[cfg(test)]
mod tests;
