//! What the drivers of timers have in common: the timer channel of each wire, and the wires of a device.

use sensedsl_board::profile::Timer;
use sensedsl_board::signal::{Function, TimerLine};
use sensedsl_model::kind::KindName;

use super::context::Context;
use super::section::GuardPlan;
use sensedsl_job::{JobConnection, JobDevice, Pad};

/// A channel of a timer at a pin.
pub(super) struct Channel<'a> {
    pub(super) timer: &'a Timer,
    /// The number of the channel, from 1.
    pub(super) number: u8,
    /// True for the complementary output.
    pub(super) is_inverted: bool,
}

/// The channel that a pad carries.
pub(super) fn channel<'a>(context: &Context<'a>, pad: &Pad<'_>) -> Option<Channel<'a>> {
    let Function::Timer { unit, channel, line } = pad.usage?.signal.function() else { return None };
    let timer = context.profile.timer(unit.as_str())?;
    Some(Channel { timer, number: *channel, is_inverted: *line == TimerLine::Inverted })
}

/// The devices of a kind that a driver serves, each with its connections.
pub(super) fn devices<'a>(
    context: &Context<'a>,
    kind: KindName,
) -> impl Iterator<Item = (&'a JobDevice<'a>, Vec<&'a JobConnection<'a>>)> {
    let of_kind = move |one: &&JobDevice<'_>| one.device.kind.name() == kind;
    let devices = context.job.devices.iter().filter(of_kind);
    devices.map(move |device| (device, context.job.wires_of(device.device)))
}

/// The number of 64-bit words that hold a value of a device.
pub(super) fn words(device: &JobDevice<'_>) -> usize {
    let value = device.device.value.value;
    (value.count() * value.scalar.size_bytes()).div_ceil(8)
}

/// Checks that the driver can derive a tick from the timer's clock.
pub(super) fn divides(timer: &Timer, tick_hz: u32) -> GuardPlan {
    let Timer { name, clock, .. } = timer;
    GuardPlan {
        condition: format!("{clock} % {tick_hz}U == 0U && {clock} / {tick_hz}U <= 65536U"),
        message: format!("the clock of {name} does not divide to {tick_hz} Hz"),
    }
}

/// Checks that the tree's timer has this many channels.
pub(super) fn has_channels(timer: &Timer, channels: u8) -> GuardPlan {
    let name = &timer.name;
    GuardPlan {
        condition: format!("STM32_{name}_CHANNELS >= {channels}"),
        message: format!("{name} has no channel {channels}"),
    }
}
