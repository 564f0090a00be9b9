//! The pins that a project has on its timers in; the role of each out. A timer serves one capture,
//! one encoder, or outputs of one frequency; what it cannot serve besides stays reserved.

use std::collections::{BTreeMap, BTreeSet};

use sensedsl_board::pin::PinName;
use sensedsl_board::signal::{Function, Signal, TimerLine};

use crate::project::chip::Chip;
use crate::project::{Project, TimerMode, Using};

/// The role of a pin for its timer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Decision {
    /// Its pulses are measured.
    Capture,
    /// Pulses come out of it.
    Pulses,
    /// It is this wire of an encoder.
    Encoder(&'static str),
    /// It is no device, and why.
    Reserved(&'static str),
}

/// A pin on a channel of a timer.
struct Channel<'a> {
    pin: &'a PinName,
    number: u8,
    line: TimerLine,
    mode: TimerMode,
}

/// Decides for each pin on a timer.
pub(super) fn decide(project: &Project, chip: &Chip) -> BTreeMap<PinName, Decision> {
    let mut timers: BTreeMap<String, Vec<Channel<'_>>> = BTreeMap::new();
    for wire in &project.wires {
        let Using::Timer(signal, mode) = &wire.using else { continue };
        let (signal, _) = Signal::parse(signal);
        let Function::Timer { unit, channel, line } = signal.function() else { continue };
        let channel = Channel { pin: &wire.pin, number: *channel, line: *line, mode: *mode };
        timers.entry(unit.to_string()).or_default().push(channel);
    }
    let mut decisions = BTreeMap::new();
    for (timer, channels) in &timers {
        let of_timer = Timer { name: timer, channels, chip };
        let mut is_measuring = false;
        let mut outputs: BTreeSet<(u8, TimerLine)> = BTreeSet::new();
        for channel in channels {
            let mut decision = of_timer.decide(channel, is_measuring);
            is_measuring |= decision == Decision::Capture;
            if decision == Decision::Pulses && !outputs.insert((channel.number, channel.line)) {
                decision = Decision::Reserved("its channel is on another pin already");
            }
            decisions.insert(channel.pin.clone(), decision);
        }
    }
    decisions
}

/// A timer and what the project has on it.
struct Timer<'a> {
    name: &'a str,
    channels: &'a [Channel<'a>],
    chip: &'a Chip,
}

impl Timer<'_> {
    fn decide(&self, channel: &Channel<'_>, is_measuring: bool) -> Decision {
        let is_encoder = self.channels.iter().any(|one| one.mode == TimerMode::Encoder);
        let puts_out = self.channels.iter().any(|one| self.puts_out(one));
        match channel.mode {
            TimerMode::Encoder if channel.line.is_input() && channel.number <= 2 => {
                if self.chip.decodes(self.name) {
                    return Decision::Encoder(if channel.number == 1 { "a" } else { "b" });
                }
                Decision::Reserved("the target has no driver for an encoder on this timer")
            }
            TimerMode::Capture | TimerMode::Output if is_encoder => {
                Decision::Reserved("its timer decodes an encoder")
            }
            TimerMode::Output if self.puts_out(channel) => Decision::Pulses,
            TimerMode::Output if channel.line == TimerLine::Inverted => {
                Decision::Reserved("inverted outputs are no devices")
            }
            TimerMode::Output => {
                Decision::Reserved("the target has no driver for pulses out of this timer")
            }
            TimerMode::Capture | TimerMode::Encoder if channel.number > 2 => {
                Decision::Reserved("captures are on channels 1 and 2 alone")
            }
            TimerMode::Capture | TimerMode::Encoder if puts_out => {
                Decision::Reserved("its timer puts out pulses")
            }
            TimerMode::Capture | TimerMode::Encoder if is_measuring => {
                Decision::Reserved("its timer measures another pin")
            }
            TimerMode::Capture
                if channel.line.is_input() && self.chip.captures(self.name, channel.number) =>
            {
                Decision::Capture
            }
            TimerMode::Capture | TimerMode::Encoder => {
                Decision::Reserved("the target has no driver for captures with this timer")
            }
            TimerMode::Unknown => {
                Decision::Reserved("the project does not say whether it is an input or an output")
            }
        }
    }

    /// Whether pulses come out of the pin: of an inverted output only where the channel's own
    /// output is not in use.
    fn puts_out(&self, channel: &Channel<'_>) -> bool {
        let is_beside = |other: &Channel<'_>| {
            other.number == channel.number && other.line != TimerLine::Inverted
        };
        let alone = channel.line != TimerLine::Inverted || !self.channels.iter().any(is_beside);
        channel.mode == TimerMode::Output
            && alone
            && self.chip.puts_out(self.name, channel.number, channel.line)
    }
}
