//! Tests of designs: a board that runs in a world under a host in, the signals of its run and the verdict on each rule
//! out.
//!
//! [`Trial`] is the host of one board: it asks for the board's identity, sets what the test sets and what the world's
//! commands say, keeps speaking so that no actuator falls back, and keeps what it is told. A design may have several
//! boards; each runs by itself, and all of them write into one [`Recording`]. [`judge`] holds the recording to the rules.
//!
//! What counts is what the board has, a millisecond at a time: of a sensor the value that it reports, of an actuator the
//! one that it has applied, whether the host, a controller or a failsafe set it. Both are seen at the same moment; the
//! reports of a sensor arrive later, and a rule over both would find fault with a board that reacts at once. The age of a
//! value and the health of a device are what the host knows.
//!
//! Into an image or a real board nobody sees ([`Tested::sees_inside`]): there counts what arrives, and what the host has
//! sent. What a controller sets is read from the wires of an emulated board ([`Tested::outputs`]). On a real one, and where
//! it goes over a bus, it is not seen, and rules about it are not judged.

mod edges;
mod tested;
mod verdict;
mod watch;

use std::collections::BTreeMap;

use sensedsl_host::Scale;
use sensedsl_job::{BoardJob, JobDevice};
use sensedsl_model::design::{Design, Device, DeviceIndex, SignalOf, Test};
use sensedsl_model::kind::Interface;
use sensedsl_rules::{Signal, Trace};
use sensedsl_wire::{
    Decoder, Direction, Event, Scalar, encode_health_request, encode_hello_request, encode_report,
};

use crate::commands::Command;
use crate::commands::outputs::Outputs;
use crate::plants::Drive;
use crate::truth::{real, scalar, scale_of};
use crate::world::{Fault, World};
pub use tested::{Culprit, Stopped, Tested};
pub use verdict::{Judged, Moment, RuleVerdict, judge, not_judged};
pub use watch::{Broken, RunningRules};

const MS: u64 = 1_000_000;
/// How often the host asks for the board's identity until it answers.
const ASK_NS: u64 = 500 * MS;
/// How often the host asks for the states of devices, where a rule is about one.
const HEALTH_NS: u64 = 100 * MS;
/// How long a board has to say who it is.
const SILENT_NS: u64 = 5_000 * MS;
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

    /// Ends an edge of a signal a millisecond after it, if that is over.
    fn settle(&mut self, number: usize, now_ns: u64) {
        let samples = self.trace.signals.get(number).map(|signal| signal.samples.as_slice());
        let edge_ns = match samples.unwrap_or_default() {
            [only] => Some(only.0),
            [.., before, last] if before.1.to_bits() != last.1.to_bits() => Some(last.0),
            _ => None,
        };
        if let Some(after_ns) = edge_ns.map(|ns| ns + MS).filter(|ns| *ns < now_ns) {
            self.repeat(number, after_ns);
        }
    }

    /// Forgets what came before a moment, but for the value that was there then.
    fn forget(&mut self, before_ns: u64) {
        for signal in &mut self.trace.signals {
            let next = signal.samples.partition_point(|sample| sample.0 <= before_ns);
            signal.samples.drain(..next.saturating_sub(2));
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
    /// Whether a rule asks when something of it rises: that holds until the next sample, so there is one a millisecond.
    has_edges: bool,
    scale: Scale,
    /// The code that an actuator has until somebody sets it, if the design says.
    first: Option<f64>,
    /// What no report has: whether the wires of the board show it.
    hidden: Option<Hidden>,
}

/// What code sets of an actuator.
enum Hidden {
    OnWires(Drive),
    OnBus,
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
    /// The newest values that came or were sent, by the device's place in the schema.
    told: BTreeMap<usize, Vec<Scalar>>,
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
                let (id, scale) = (device.id.value, scale_of(&device.shown));
                let has_edges = edges.contains(&number);
                let (of, first) = (signal.of, first(device));
                let hidden = is_hidden(job.design, signal.device, of)
                    .then(|| Hidden::of(job, signal.device, of));
                Some(Watched { number, of, index, id, has_edges, scale, first, hidden })
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
            told: BTreeMap::new(),
        }
    }

    /// The signals that nobody sees on that board: what code sets of actuators, unless its wires show it.
    #[must_use]
    pub fn unseen(&self, board: &dyn Tested) -> Vec<usize> {
        if board.sees_inside() {
            return Vec::new();
        }
        let has_wires = board.outputs().is_some();
        let unseen = self.watched.iter().filter(|one| match one.hidden {
            None => false,
            Some(Hidden::OnWires(_)) => !has_wires,
            Some(Hidden::OnBus) => true,
        });
        unseen.map(|one| one.number).collect()
    }

    /// Whether the board has said that its schema is that of the file.
    #[must_use]
    pub const fn is_known(&self) -> bool {
        self.is_known
    }

    /// Runs a board to the end of the test. Returns why it could not.
    pub fn run(&mut self, board: &mut dyn Tested, recording: &mut Recording) -> Option<Stopped> {
        board.link_open();
        // The clock of the test: an emulated processor stands behind an instruction, a little later.
        let mut now_ns = board.now_ns() / MS * MS;
        while now_ns < self.test.lasts_ns {
            let bytes = self.said(now_ns);
            board.link_write(&bytes);
            let next_ns = now_ns + MS;
            board.run_until(next_ns);
            let bytes = board.link_read();
            self.hear(next_ns, &bytes, recording);
            self.see(next_ns, board, recording);
            if let Some(stopped) = board.stopped() {
                return Some(stopped);
            }
            if !self.is_known && !board.sees_inside() && next_ns >= SILENT_NS {
                let why = "it has not said that it has the schema of this file".to_owned();
                return Some(Stopped { at_ns: next_ns, culprit: Culprit::Board, why });
            }
            now_ns = next_ns;
        }
        None
    }

    /// What the host sends in this millisecond.
    fn said(&mut self, now_ns: u64) -> Vec<u8> {
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
            if let Some(at) = self.job.devices.iter().position(|device| device.index == one.device)
            {
                self.told.insert(at, one.value.clone());
            }
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
        let (watched, told, devices) = (&self.watched, &mut self.told, &self.job.devices);
        self.decoder.feed(bytes, |event| match event {
            Event::Report(_, values) => {
                came_ns.extend(values.iter().map(|(id, _)| (*id, now_ns)));
                for (id, value) in values {
                    let is_it = |one: &JobDevice<'_>| {
                        one.device.direction == Direction::Sensor && one.device.id.value == id
                    };
                    told.extend(devices.iter().position(is_it).map(|at| (at, value.clone())));
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

    /// The value as it is shown; none until there is one.
    fn shown(&self, one: &Watched, board: &dyn Tested, outputs: Option<&Outputs>) -> Option<f64> {
        match (&one.hidden, outputs) {
            (Some(Hidden::OnWires(drive)), Some(outputs)) if !board.sees_inside() => {
                drive.on_wires(outputs)
            }
            _ => self.value_of(one, board).map(|raw| one.scale.shown(raw)),
        }
    }

    /// The code that the board has; none until it has one.
    fn value_of(&self, one: &Watched, board: &dyn Tested) -> Option<f64> {
        let SignalOf::Value(element) = one.of else { return None };
        if !board.sees_inside() {
            let told = self.told.get(&one.index).and_then(|value| value.get(element));
            return told.copied().map(real).or(one.first);
        }
        let Some(bytes) = board.applied(one.index) else { return one.first };
        let scalar = self.job.schema.items.get(one.index)?.value.scalar;
        scalar.read(bytes.chunks_exact(scalar.size_bytes()).nth(element)?).map(real)
    }

    /// Looks at what the board has, and at the clock.
    fn see(&self, now_ns: u64, board: &dyn Tested, recording: &mut Recording) {
        let has_hidden = self.watched.iter().any(|one| one.hidden.is_some());
        let outputs = if has_hidden { board.outputs() } else { None };
        for one in &self.watched {
            match one.of {
                SignalOf::Age => {
                    let since_ns = self.came_ns.get(&one.id).copied().unwrap_or(0);
                    let age_ms = crate::arith::number((now_ns - since_ns) / MS);
                    if let Some(signal) = self.test.signals.get(one.number) {
                        recording.take(one.number, now_ns, signal.unit.computed(age_ms));
                    }
                }
                SignalOf::Value(_) => {
                    let shown = self.shown(one, board, outputs.as_ref());
                    let signal = self.test.signals.get(one.number);
                    if let Some((shown, signal)) = shown.zip(signal) {
                        recording.take(one.number, now_ns, signal.unit.computed(shown));
                    }
                }
                SignalOf::Health => {}
            }
            if one.has_edges {
                recording.repeat(one.number, now_ns);
            }
        }
    }
}

impl Hidden {
    fn of(job: &BoardJob<'_>, device: DeviceIndex, of: SignalOf) -> Self {
        let drive = match of {
            SignalOf::Value(element) => Drive::of(job, device, element),
            SignalOf::Age | SignalOf::Health => None,
        };
        drive.filter(|drive| !drive.is_told()).map_or(Self::OnBus, Self::OnWires)
    }
}

/// Whether no report has it: what code sets of an actuator.
fn is_hidden(design: &Design, device: DeviceIndex, of: SignalOf) -> bool {
    let is_actuator = design
        .device(device)
        .is_some_and(|one| one.direction == Direction::Actuator && one.kind.code().is_none());
    let mut set = design.controllers.iter().flat_map(|one| &one.sets);
    is_actuator && matches!(of, SignalOf::Value(_)) && set.any(|one| one.value == device)
}

/// The code that an actuator has until somebody sets it; none of a sensor, and where only a part itself knows.
fn first(device: &Device) -> Option<f64> {
    if device.direction == Direction::Sensor {
        return None;
    }
    if let Some(safe) = device.kind.failsafe() {
        return Some(safe);
    }
    match device.kind.interface() {
        Interface::Digital(own) => Some(f64::from(u8::from(own.initial))),
        Interface::Pwm(_) | Interface::Dac(_) | Interface::Stepper(_) => Some(0.0),
        Interface::Code(own) => Some(own.default),
        Interface::Analog(_)
        | Interface::I2c(_)
        | Interface::Icu(_)
        | Interface::Encoder(_)
        | Interface::Uart(_)
        | Interface::Spi(_)
        | Interface::Can(_)
        | Interface::OneWire(_) => None,
    }
}

#[cfg(test)]
mod tests;
