//! The outputs of a board: levels, pulses, voltages, bytes on buses, frames. The bench records them as they happen.

use std::collections::{BTreeMap, VecDeque};

use sensedsl_board::signal::{Function, TimerLine};
use sensedsl_job::JobConnection;
use sensedsl_model::design::ConnectionIndex;
use sensedsl_model::kind::Role;

use super::track::Track;
use crate::bench::number_of;
use sensedsl_surroundings::{CanFrame, TimerOutput};

/// The most transfers, bytes and frames that are kept for each wire: more than one step of a script makes.
const KEPT: usize = 4_096;

/// The current state of each wire, and the latest data on buses.
#[derive(Clone, Debug, Default)]
pub struct Outputs {
    levels: BTreeMap<(ConnectionIndex, Role), bool>,
    pulses: BTreeMap<ConnectionIndex, (u64, u64)>,
    millivolts: BTreeMap<ConnectionIndex, f64>,
    writes: BTreeMap<ConnectionIndex, VecDeque<(u64, Vec<u8>)>>,
    bytes: BTreeMap<u8, VecDeque<(u64, u8)>>,
    frames: BTreeMap<u8, VecDeque<(u64, CanFrame)>>,
    tracks: BTreeMap<ConnectionIndex, Track>,
    /// What was wrong with what a strip or a display was sent last.
    wrong: BTreeMap<ConnectionIndex, String>,
}

fn keep<T>(log: &mut VecDeque<T>, one: T) {
    if log.len() >= KEPT {
        log.pop_front();
    }
    log.push_back(one);
}

impl Outputs {
    /// The level that the board gives a wire; `None` if it no longer drives the wire, or never has.
    #[must_use]
    pub fn level(&self, at: ConnectionIndex, role: Role) -> Option<bool> {
        self.levels.get(&(at, role)).copied()
    }

    /// The way of a motor.
    pub(super) fn track(&self, at: ConnectionIndex) -> Option<&Track> {
        self.tracks.get(&at)
    }

    /// Period and width of the pulses on a wire, in nanoseconds.
    #[must_use]
    pub fn pulses(&self, at: ConnectionIndex) -> Option<(u64, u64)> {
        self.pulses.get(&at).copied()
    }

    /// The voltage of a DAC's output.
    #[must_use]
    pub fn millivolts(&self, at: ConnectionIndex) -> Option<f64> {
        self.millivolts.get(&at).copied()
    }

    /// The data written to a chip since a given time, one item for each transfer.
    pub fn writes(&self, at: ConnectionIndex, since_ns: u64) -> impl Iterator<Item = &[u8]> {
        let all = self.writes.get(&at).into_iter().flatten();
        all.filter(move |(when, _)| *when >= since_ns).map(|(_, bytes)| bytes.as_slice())
    }

    /// What is wrong with what a strip or a display was sent last; none if it shows something.
    #[must_use]
    pub fn wrong(&self, at: ConnectionIndex) -> Option<&str> {
        self.wrong.get(&at).map(String::as_str)
    }

    /// The bytes that a serial port has sent since a given time.
    #[must_use]
    pub fn bytes(&self, unit: u8, since_ns: u64) -> Vec<u8> {
        let all = self.bytes.get(&unit).into_iter().flatten();
        all.filter(|(when, _)| *when >= since_ns).map(|(_, byte)| *byte).collect()
    }

    /// The frames sent on a CAN bus since a given time.
    pub fn frames(&self, unit: u8, since_ns: u64) -> impl Iterator<Item = &CanFrame> {
        let all = self.frames.get(&unit).into_iter().flatten();
        all.filter(move |(when, _)| *when >= since_ns).map(|(_, frame)| frame)
    }
}

/// The outputs together with the state that is needed to record them: the wire of each timer channel, and unfinished
/// transfers.
#[derive(Clone, Debug, Default)]
pub(crate) struct Recorder {
    outputs: Outputs,
    channels: BTreeMap<TimerOutput, ConnectionIndex>,
    converters: BTreeMap<u8, ConnectionIndex>,
    /// The unfinished transfers, by I2C unit.
    open: BTreeMap<u8, (ConnectionIndex, Vec<u8>)>,
    /// The unfinished transfers, by SPI chip.
    selected: BTreeMap<ConnectionIndex, Vec<u8>>,
}

impl Recorder {
    /// Adds a connection of the board.
    pub(crate) fn connect(&mut self, one: &JobConnection<'_>) {
        let kind = &one.connection.kind;
        let is_output = kind.pwm().is_some() || kind.dac().is_some() || kind.stepper().is_some();
        let signal = one
            .pad(Role::Out)
            .or_else(|| one.pad(Role::Step))
            .and_then(|pad| pad.usage)
            .map(|usage| &usage.signal);
        match signal.filter(|_| is_output).map(sensedsl_board::signal::Signal::function) {
            Some(Function::Timer { unit, channel, line }) => {
                let Some(timer) = number_of(unit.as_str()) else { return };
                let is_complement = *line == TimerLine::Inverted;
                let output = TimerOutput { timer, channel: *channel, is_complement };
                self.channels.insert(output, one.index);
            }
            Some(Function::Dac { unit, channel }) => {
                let before = 2 * unit.saturating_sub(1);
                self.converters.insert(before + channel, one.index);
            }
            Some(_) | None => {}
        }
    }

    pub(crate) const fn outputs(&self) -> &Outputs {
        &self.outputs
    }

    pub(crate) fn level(
        &mut self,
        at: ConnectionIndex,
        role: Role,
        level: Option<bool>,
        now_ns: u64,
    ) {
        match (self.outputs.tracks.get(&at), role) {
            (Some(track), Role::Dir) => track.direct(level, now_ns),
            (Some(track), Role::Enable) => track.enable(level),
            (Some(_) | None, _) => {}
        }
        match level {
            Some(level) => self.outputs.levels.insert((at, role), level),
            None => self.outputs.levels.remove(&(at, role)),
        };
    }

    /// The motor of a connection, from now on.
    pub(crate) fn follow(&mut self, at: ConnectionIndex, track: Track) {
        self.outputs.tracks.insert(at, track);
    }

    /// The board has lost its supply.
    pub(crate) fn power_up(&mut self) {
        self.outputs.tracks.values().for_each(Track::reset);
    }

    /// A timer has made a single pulse.
    pub(crate) fn pulse(&mut self, output: TimerOutput, from_ns: u64, width_ns: u64) {
        if let Some(at) = self.channels.get(&output).copied() {
            self.step(at, from_ns, width_ns);
        }
    }

    /// A motor gets a pulse.
    pub(crate) fn step(&mut self, at: ConnectionIndex, from_ns: u64, width_ns: u64) {
        if let Some(track) = self.outputs.tracks.get(&at) {
            track.pulse(from_ns, width_ns);
        }
    }

    pub(crate) fn timer(&mut self, output: TimerOutput, period_ns: u64, width_ns: u64) {
        if let Some(at) = self.channels.get(&output).copied() {
            self.pulses(at, period_ns, width_ns);
        }
    }

    pub(crate) fn pulses(&mut self, at: ConnectionIndex, period_ns: u64, width_ns: u64) {
        self.outputs.pulses.insert(at, (period_ns, width_ns));
    }

    pub(crate) fn converter(&mut self, channel: u8, millivolts: f64) {
        if let Some(at) = self.converters.get(&channel).copied() {
            self.millivolts(at, millivolts);
        }
    }

    pub(crate) fn millivolts(&mut self, at: ConnectionIndex, millivolts: f64) {
        self.outputs.millivolts.insert(at, millivolts);
    }

    /// A chip on I2C is addressed, or the bus is released.
    pub(crate) fn addressed(&mut self, unit: u8, chip: Option<ConnectionIndex>, now_ns: u64) {
        if let Some((at, bytes)) = self.open.remove(&unit) {
            self.written(at, bytes, now_ns);
        }
        if let Some(chip) = chip {
            self.open.insert(unit, (chip, Vec::new()));
        }
    }

    /// The chip that was addressed last has taken a byte.
    pub(crate) fn taken(&mut self, unit: u8, byte: u8) {
        if let Some((_, bytes)) = self.open.get_mut(&unit).filter(|(_, all)| all.len() < KEPT) {
            bytes.push(byte);
        }
    }

    /// The chip select of an SPI chip changes.
    pub(crate) fn select(&mut self, chip: ConnectionIndex, is_selected: bool, now_ns: u64) {
        if is_selected {
            self.selected.insert(chip, Vec::new());
        } else if let Some(bytes) = self.selected.remove(&chip) {
            self.written(chip, bytes, now_ns);
        }
    }

    /// An SPI chip has received a byte.
    pub(crate) fn shifted(&mut self, chip: ConnectionIndex, byte: u8) {
        if let Some(bytes) = self.selected.get_mut(&chip).filter(|all| all.len() < KEPT) {
            bytes.push(byte);
        }
    }

    /// A strip or a display shows something, or cannot.
    pub(crate) fn shown(
        &mut self,
        at: ConnectionIndex,
        shown: Result<Vec<u8>, String>,
        now_ns: u64,
    ) {
        match shown {
            Ok(bytes) => {
                self.outputs.wrong.remove(&at);
                self.written(at, bytes, now_ns);
            }
            Err(wrong) => {
                self.outputs.wrong.insert(at, wrong);
            }
        }
    }

    fn written(&mut self, at: ConnectionIndex, bytes: Vec<u8>, now_ns: u64) {
        if !bytes.is_empty() {
            keep(self.outputs.writes.entry(at).or_default(), (now_ns, bytes));
        }
    }

    pub(crate) fn sent(&mut self, unit: u8, byte: u8, now_ns: u64) {
        keep(self.outputs.bytes.entry(unit).or_default(), (now_ns, byte));
    }

    pub(crate) fn frame(&mut self, unit: u8, frame: CanFrame, now_ns: u64) {
        keep(self.outputs.frames.entry(unit).or_default(), (now_ns, frame));
    }
}
