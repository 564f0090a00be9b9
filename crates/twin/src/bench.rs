//! The bench: a board's wiring, with parts behind its pins and a world around them.
//!
//! In: the job of a board, and a world. Out: [`Surroundings`](sensedsl_surroundings::Surroundings) for an emulated MCU,
//! and the same, addressed by connection, for a board that knows no pads. The world's faults happen here.

use std::collections::BTreeMap;

use sensedsl_job::kinds::serial;
use sensedsl_job::{BoardJob, JobConnection};
use sensedsl_model::design::{ConnectionIndex, Device, DeviceIndex, PartIndex};
use sensedsl_model::kind::{Interface, Kind, Role};
use sensedsl_model::words::Words;
use sensedsl_wire::Direction;

use crate::arith::{chance, number};
use crate::commands::Command;
use crate::commands::outputs::Recorder;
use crate::parts::line::{Edges, Line, Spikes};
use crate::parts::{can, dialogue, formula, message, onewire as onewire_part};
use crate::plants::SharedPlants;
use crate::range::is_counter;
use crate::truth::Subject;
use crate::world::{FaultKind, World, usual};
use sensedsl_surroundings::{Pad, TimerOutput};

mod broken;
mod chips;
mod faults;
mod held;
mod log;
mod mcu;
mod motors;
mod onewire;
mod peer;
mod planted;
mod recorded;
mod seen;
mod shows;
mod stations;
mod units;

use broken::Broken;
use chips::Chip;
pub use chips::UncheckedIdentity;
use held::Held;
pub use peer::Peer;
pub(crate) use units::Units;
pub use units::number_of;

/// The full-scale reading of a converter, and the voltage that gives it.
const FULL: f64 = 4_095.0;
const REFERENCE_MV: f64 = 3_300.0;
const MS_NS: u64 = 1_000_000;

/// A board's pins and what is behind them.
#[derive(Clone, Debug)]
pub struct Bench {
    subjects: Vec<Subject>,
    wires: BTreeMap<ConnectionIndex, Wired>,
    pads: BTreeMap<Pad, (ConnectionIndex, Role)>,
    chips: Vec<Chip>,
    /// The wires that both ends pull low, and which of them a connection is on.
    one_wires: Vec<onewire_part::Wire>,
    on_wire: BTreeMap<ConnectionIndex, usize>,
    talkers: BTreeMap<u8, ConnectedSender>,
    lines: BTreeMap<u8, dialogue::Line>,
    senders: BTreeMap<u8, Vec<(PartIndex, can::Sender)>>,
    shows: shows::Shows,
    /// The chip that an I2C unit talks to.
    talked_to: BTreeMap<u8, usize>,
    /// Period and width of the pulses, by timer and channel.
    waves: BTreeMap<TimerOutput, (u64, u64)>,
    recorder: Recorder,
    commands: Vec<Command>,
    faults: Vec<Broken>,
    held: Held,
    units: Units,
    /// The peer on the CAN buses that replaces the world's stations.
    peer: Option<Peer>,
    /// What turns the outputs into what sensors measure.
    pub(crate) plants: Option<SharedPlants>,
    /// What parts on buses were told, if the board says so.
    codes: BTreeMap<DeviceIndex, Vec<f64>>,
    seed: u64,
    log: Option<log::Log>,
}

/// A connection and what is behind it.
#[derive(Clone, Debug)]
struct Wired {
    part: PartIndex,
    line: Option<(Line, Option<Line>)>,
    analog: Option<Analog>,
}

#[derive(Clone, Debug)]
struct Analog {
    subject: usize,
    element: usize,
    thermistor: Option<(sensedsl_model::protocol::Formula, Vec<i32>)>,
}

#[derive(Clone, Debug)]
struct ConnectedSender {
    part: PartIndex,
    talker: message::MessageSender,
}

impl Bench {
    /// Puts the parts of a board's job on its pins.
    #[must_use]
    pub fn new(job: &BoardJob<'_>, world: &World, seed: u64) -> Self {
        let mut bench = Self {
            subjects: subjects(job, world),
            wires: BTreeMap::new(),
            pads: BTreeMap::new(),
            chips: Vec::new(),
            one_wires: Vec::new(),
            on_wire: BTreeMap::new(),
            talkers: BTreeMap::new(),
            lines: BTreeMap::new(),
            senders: BTreeMap::new(),
            shows: shows::Shows::default(),
            talked_to: BTreeMap::new(),
            waves: BTreeMap::new(),
            recorder: Recorder::default(),
            commands: world.commands.clone(),
            faults: world.faults.iter().map(|fault| Broken::new(job, fault)).collect(),
            held: Held::default(),
            units: Units::new(job),
            peer: None,
            plants: SharedPlants::new(job, world),
            codes: BTreeMap::new(),
            seed,
            log: None,
        };
        for one in &job.connections {
            bench.add(job, one);
        }
        bench.motors(job);
        bench
    }

    /// The board's sensors and their signals, in the order of the file.
    #[must_use]
    pub fn subjects(&self) -> &[Subject] {
        &self.subjects
    }

    /// Holds an element of a sensor at a value in the sensor's own unit from a moment on; `None` lets the world have it
    /// again. A device or an element that is not there changes nothing.
    pub fn hold(&mut self, device: DeviceIndex, element: usize, shown: Option<f64>, now_ns: u64) {
        let mut subjects = self.subjects.iter_mut().enumerate();
        if let Some(one) = subjects.find(|(_, one)| one.device == device) {
            self.held.hold(one, element, shown, now_ns);
        }
    }

    /// The time between two messages or frames of a device that sends by itself.
    #[must_use]
    pub fn period_ns(&self, part: PartIndex) -> Option<u64> {
        let talker = self.talkers.values().find(|one| one.part == part);
        let of_part =
            |(of, sender): &(PartIndex, can::Sender)| (*of == part).then(|| sender.round_ns());
        let senders = || self.senders.values().flatten().filter_map(of_part).max();
        let round_ns = self.lines.values().find_map(|line| line.round_ns(part));
        round_ns.or_else(|| talker.map(|one| one.talker.period_ns())).or_else(senders)
    }

    /// The times, from start to end, at which a fault may keep a device from reporting.
    #[must_use]
    pub fn excused(&self, job: &BoardJob<'_>, device: DeviceIndex) -> Vec<(u64, u64)> {
        let own = job.devices.iter().find(|one| one.index == device);
        let hits = |Broken { fault, part, units }: &Broken| {
            let is_own = own.is_some_and(|own| {
                let shares = own.unit.is_some_and(|unit| units.iter().any(|one| one == unit));
                let is_of_bus = matches!(fault.kind, FaultKind::StuckSda | FaultKind::Hang);
                *part == Some(own.device.part) || (is_of_bus && shares)
            });
            (fault.kind.is_of_board() || is_own).then_some((fault.at_ns, fault.until_ns))
        };
        self.faults.iter().filter_map(hits).collect()
    }

    /// Period and width, in nanoseconds, of the pulses that the board sends, by timer and channel.
    #[must_use]
    pub fn waves(&self) -> &BTreeMap<TimerOutput, (u64, u64)> {
        &self.waves
    }

    /// Puts a peer on the CAN buses of the board: from now on, the frames of the world's devices there are not sent.
    pub fn open_can(&mut self, job: &BoardJob<'_>) -> Peer {
        let on_can = job.connections.iter().filter(|one| one.connection.kind.can().is_some());
        let units = on_can.filter_map(|one| self.units.number(one.unit?)).collect();
        let peer = Peer::new(units);
        self.peer = Some(peer.clone());
        peer
    }

    /// Whether the board has no supply.
    #[must_use]
    pub fn is_off(&self, now_ns: u64) -> bool {
        self.faults.iter().any(|one| one.is(FaultKind::Reset, now_ns))
    }

    /// The random byte that arrives on the link in this millisecond, if one does.
    #[must_use]
    pub fn garbage(&self, now_ns: u64) -> Option<u8> {
        self.faults.iter().find(|one| one.is(FaultKind::Garbage, now_ns))?;
        let chance = crate::arith::scrambled(self.seed ^ now_ns);
        chance.to_be_bytes().first().copied()
    }

    /// The supply is back: parts have lost what was written to them.
    pub fn power_up(&mut self, now_ns: u64) {
        for part in self.one_wires.iter_mut().flat_map(|wire| &mut wire.parts) {
            part.reset(now_ns);
        }
        for chip in &mut self.chips {
            chip.registers.reset();
        }
        self.darken();
        self.talked_to.clear();
        self.recorder.power_up();
    }

    /// The voltage at a connection.
    pub fn millivolts_at(&self, connection: ConnectionIndex, now_ns: u64) -> f64 {
        let Some(wired) = self.wires.get(&connection) else { return 0.0 };
        if self.has(FaultKind::Torn, wired.part, now_ns) {
            // An input that nothing drives floats.
            return REFERENCE_MV / 2.0 * (1.0 + chance(self.seed ^ (now_ns / MS_NS)) / 4.0);
        }
        let Some(analog) = &wired.analog else { return 0.0 };
        let Some(subject) = self.subjects.get(analog.subject) else { return 0.0 };
        let raw = subject.raw(analog.element, now_ns);
        let level = match &analog.thermistor {
            None => raw,
            Some((of, parameters)) => {
                let bytes = formula::raw(*of, parameters, [Some(raw), None, None]);
                bytes.iter().fold(0.0, |sum, byte| sum * 256.0 + f64::from(*byte))
            }
        };
        level.clamp(0.0, FULL) * REFERENCE_MV / FULL
    }

    /// The level on a wire of a connection; `None` if nothing drives it.
    pub fn level_at(
        &mut self,
        connection: ConnectionIndex,
        role: Role,
        now_ns: u64,
    ) -> Option<bool> {
        if self.is_cut(connection, now_ns) {
            return None;
        }
        if role == Role::Data {
            return self.line_level(connection, now_ns);
        }
        let wired = self.wires.get_mut(&connection)?;
        let (first, second) = wired.line.as_mut()?;
        let line = if role == Role::B { second.as_mut()? } else { first };
        (role != Role::Trigger).then(|| line.level(&self.subjects, now_ns))
    }

    /// The next edge on a wire of a connection.
    pub fn next_edge_at(
        &mut self,
        connection: ConnectionIndex,
        role: Role,
        after_ns: u64,
    ) -> Option<(u64, bool)> {
        if role == Role::Data {
            return self.line_edge(connection, after_ns);
        }
        let wired = self.wires.get_mut(&connection)?;
        let (first, second) = wired.line.as_mut()?;
        let line = if role == Role::B { second.as_mut()? } else { first };
        let mut after_ns = after_ns;
        // Edges that a fault swallows are skipped; the signal goes on after the fault.
        for _ in 0..100_000 {
            let (at, level) = line.next_edge(&self.subjects, after_ns)?;
            let part = wired.part;
            let is_cut = self.faults.iter().any(|one| one.cuts(at) && one.part == Some(part));
            if !is_cut {
                return Some((at, level));
            }
            after_ns = at;
        }
        None
    }

    /// The board drives a wire of a connection.
    pub fn drive_at(
        &mut self,
        connection: ConnectionIndex,
        role: Role,
        level: Option<bool>,
        now_ns: u64,
    ) {
        self.recorder.level(connection, role, level, now_ns);
        if role == Role::Data {
            self.drive_line(connection, level, now_ns);
        }
        if role == Role::Cs
            && let Some(chip) = self.chips.iter_mut().find(|one| one.connection == connection)
        {
            let is_selected = level == Some(false);
            match (chip.is_selected, is_selected) {
                (false, true) => chip.registers.select(now_ns),
                (true, false) => chip.registers.deselect(now_ns),
                (true, true) | (false, false) => {}
            }
            chip.is_selected = is_selected;
            self.recorder.select(connection, is_selected, now_ns);
        }
        if role == Role::Direction
            && let Some(line) = self.lines.values_mut().find(|line| line.is_at(connection))
        {
            line.give(level == Some(true));
        }
        if role == Role::Trigger
            && level == Some(false)
            && let Some((line, _)) =
                self.wires.get_mut(&connection).and_then(|wired| wired.line.as_mut())
        {
            line.triggered(&self.subjects, now_ns);
        }
    }
}

/// Placement of parts on pins.
impl Bench {
    fn add(&mut self, job: &BoardJob<'_>, one: &JobConnection<'_>) {
        for pad in &one.pads {
            if let Some(named) = Pad::named(&pad.pin.name.to_string()) {
                self.pads.entry(named).or_insert((one.index, pad.role));
            }
        }
        self.recorder.connect(one);
        let part = one.connection.part;
        let unit = one.unit.and_then(|name| self.units.number(name));
        let mut wired = Wired { part, line: None, analog: None };
        let devices: Vec<&Device> = job
            .devices
            .iter()
            .filter(|of| of.device.part == part && of.device.direction == Direction::Sensor)
            .map(|of| of.device)
            .collect();
        let over = one.devices.iter().filter_map(|at| job.devices.get(*at));
        let first = over.map(|of| of.device).find(|of| of.direction == Direction::Sensor);
        let element = usize::from(one.element());
        match (one.connection.kind.interface(), unit) {
            (Interface::Spi(_), Some(unit)) if self.light(one, unit) => {}
            (Interface::I2c(_) | Interface::Spi(_), Some(unit)) => {
                self.chips.push(self.chip(job, one, unit));
                self.display(one, shows::is_text(job, one));
            }
            (Interface::Uart(uart), Some(unit)) if serial::is_dialogue(job, one) => {
                let station = self.station(job, one);
                let fresh = || dialogue::Line::new(uart.clone());
                self.lines.entry(unit).or_insert_with(fresh).add(station);
            }
            (Interface::Uart(uart), Some(unit)) if !devices.is_empty() => {
                let fields = devices.iter().filter_map(|of| self.field(of)).collect();
                let delay_ns = MS_NS * u64::from(one.cycle.delay_ms);
                let talker =
                    message::MessageSender::new(uart.clone(), fields, delay_ns, &self.subjects);
                self.talkers.insert(unit, ConnectedSender { part, talker });
            }
            (Interface::OneWire(own), _) => self.hang(job, one, own),
            (Interface::Can(_), Some(unit)) => self.stations(unit, part, &devices),
            // Nothing is sent without a unit, or by a part that is only written.
            (Interface::I2c(_) | Interface::Spi(_) | Interface::Uart(_) | Interface::Can(_), _) => {
            }
            (
                Interface::Analog(_)
                | Interface::Icu(_)
                | Interface::Encoder(_)
                | Interface::Digital(_)
                | Interface::Pwm(_)
                | Interface::Dac(_)
                | Interface::Stepper(_)
                | Interface::Code(_),
                _,
            ) => {
                wired.analog = first.and_then(|of| self.analog(job, of, element));
                wired.line = first.and_then(|of| self.line(&one.connection.kind, of, element));
            }
        }
        self.wires.insert(one.index, wired);
    }

    /// Adds the frames that a part sends on a CAN bus.
    fn stations(&mut self, unit: u8, part: PartIndex, devices: &[&Device]) {
        for of in devices {
            let Some((can, words)) = of.kind.can().zip(Words::of(of)) else { continue };
            let Some(subject) = self.subject(of) else { continue };
            let select = can.select();
            let field = can::Field { subject, byte: can.byte, words, select, length: can.length };
            let senders = self.senders.entry(unit).or_default();
            let known = senders
                .iter()
                .position(|(_, one)| one.id == can.frame_id && one.is_extended == can.is_extended);
            let place = known.unwrap_or(senders.len());
            if known.is_none() {
                senders.push((part, can::Sender::new(can.frame_id, can.is_extended)));
            }
            if let Some((_, sender)) = senders.get_mut(place) {
                sender.add(field, MS_NS * u64::from(of.delay_ms));
            }
        }
    }

    fn subject(&self, device: &Device) -> Option<usize> {
        self.subjects.iter().position(|one| one.id == device.id.value)
    }

    fn analog(&self, job: &BoardJob<'_>, device: &Device, element: usize) -> Option<Analog> {
        device.kind.analog()?;
        let chip = job.design.part(device.part).and_then(|part| part.chip.as_ref());
        let formula = chip.filter(|_| device.coding.output.is_some());
        let thermistor = formula.and_then(|chip| Some((chip.formula?, chip.parameters.clone())));
        Some(Analog { subject: self.subject(device)?, element, thermistor })
    }

    fn line(&self, kind: &Kind, device: &Device, element: usize) -> Option<(Line, Option<Line>)> {
        let subject = self.subject(device)?;
        Some(match kind.interface() {
            Interface::Digital(own) if is_counter(kind, device) => {
                let edges = match own.edge {
                    Some(sensedsl_model::kind::digital::Edge::Both) => Edges::Both,
                    Some(sensedsl_model::kind::digital::Edge::Falling) => Edges::Falling,
                    Some(sensedsl_model::kind::digital::Edge::Rising) | None => Edges::Rising,
                };
                (Line::Count { subject, element, edges }, None)
            }
            Interface::Digital(own) => {
                let spikes = Spikes::below(1_000 * u64::from(own.debounce_us));
                let is_active_low = own.active_low;
                (Line::Level { subject, element, is_active_low, spikes }, None)
            }
            Interface::Icu(icu) => {
                (Line::of_capture(icu, subject, element, self.subjects.get(subject)?), None)
            }
            Interface::Encoder(_) => {
                let track = |is_second| Line::Track { subject, element, is_second };
                (track(false), Some(track(true)))
            }
            Interface::Analog(_)
            | Interface::I2c(_)
            | Interface::Uart(_)
            | Interface::Spi(_)
            | Interface::Pwm(_)
            | Interface::Dac(_)
            | Interface::Can(_)
            | Interface::OneWire(_)
            | Interface::Stepper(_)
            | Interface::Code(_) => return None,
        })
    }

    fn field(&self, device: &Device) -> Option<message::Field> {
        Some(message::Field {
            subject: self.subject(device)?,
            byte: device.coding.byte,
            words: Words::of(device),
            text: device.coding.text.clone(),
        })
    }
}

/// The board's sensors and their signals.
fn subjects(job: &BoardJob<'_>, world: &World) -> Vec<Subject> {
    let sensors = job.devices.iter().filter(|one| one.device.direction == Direction::Sensor);
    let subject = sensors.map(|one| {
        let own = world.signals.get(&one.index);
        let signals = own.cloned().unwrap_or_else(|| usual(one.index, one.device));
        Subject::new(one.index, one.device, signals)
    });
    subject.collect()
}

/// The value that a converter gives for a voltage, with the fraction that the average of many samples has.
#[must_use]
pub fn converted(millivolts: f64) -> f64 {
    (millivolts * FULL / REFERENCE_MV).clamp(0.0, FULL)
}

/// A time in seconds.
#[must_use]
pub fn seconds(now_ns: u64) -> f64 {
    number(now_ns) / 1e9
}
