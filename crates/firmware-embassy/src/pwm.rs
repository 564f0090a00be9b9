//! Pulses of timers: all outputs of a timer are set by the values of one or more devices.

use std::collections::BTreeMap;

use sensedsl_board::signal::{Function, TimerLine};
use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::kind::{KindName, Role};

use super::actuators::{actuators, element, is_bridge, level};
use super::context::{Context, Wired};
use super::hal::contract::outputs::{Hold, Output, Pulse, Pulses, Timer};
use super::missing::{self, Printed};
use super::section::Section;
use sensedsl_job::JobConnection;
use sensedsl_job::snake;

pub(super) fn plan(
    context: &Context<'_>,
    pulses: &dyn Pulses,
    section: &mut Section,
    diagnostics: &mut Vec<Diagnostic>,
) {
    let mut timers: BTreeMap<&str, Vec<Output<'_>>> = BTreeMap::new();
    for wired in actuators(context, KindName::Pwm) {
        for (at, wire) in wired.wires.iter().copied().enumerate() {
            match output(context, &wired, at, wire) {
                Ok((unit, output)) => timers.entry(unit).or_default().push(output),
                Err(missing) => context.report(wire.part, Err(missing), diagnostics),
            }
        }
    }
    for (unit, outputs) in timers {
        let made = timer(context, pulses, unit, &outputs, section);
        if let Some(first) = outputs.first() {
            context.report(first.wire.part, made, diagnostics);
        }
    }
}

/// An element of a value on its channel, with the unit of the channel.
fn output<'a>(
    context: &Context<'_>,
    wired: &Wired<'a>,
    at: usize,
    wire: &'a JobConnection<'a>,
) -> Printed<(&'a str, Output<'a>)> {
    let pwm = missing::kind(wire.connection.kind.pwm())?;
    let (pulse, pin) = (pulse(context, wire)?, &missing::pad(wire, Role::Out)?.pin.name);
    Ok((missing::unit(wire)?, Output { wired: wired.clone(), at, wire, pin, pwm, pulse }))
}

/// The output of a timer that a wire is on.
pub(super) fn pulse(context: &Context<'_>, wire: &JobConnection<'_>) -> Printed<Pulse> {
    let own = missing::kind(wire.connection.kind.pwm())?;
    let (unit, pad) = (missing::unit(wire)?, missing::pad(wire, Role::Out)?);
    let period_us = 1_000_000 / own.frequency_hz.max(1);
    let is_whole = own.min_us.is_none() && own.max_us.is_none();
    Ok(Pulse {
        name: snake(unit),
        timer: context.peripheral(unit),
        channel: missing::channel(pad)?,
        is_complement: matches!(
            pad.usage.map(|usage| usage.signal.function()),
            Some(Function::Timer { line: TimerLine::Inverted, .. })
        ),
        // Shares of the whole period need no microseconds, of which there may be few.
        min_us: own.min_us.unwrap_or(0),
        max_us: if is_whole { 1 } else { own.max_us.unwrap_or(period_us) },
        period_us: if is_whole { 1 } else { period_us },
    })
}

/// A timer with what sets its outputs. The outputs of bridges are set by the bridge.
fn timer(
    context: &Context<'_>,
    pulses: &dyn Pulses,
    unit: &str,
    outputs: &[Output<'_>],
    section: &mut Section,
) -> Printed<()> {
    let timer = pulses.timer(context, unit, outputs)?;
    let plain = outputs.iter().filter(|one| !is_bridge(&one.wired));
    for output in plain.clone() {
        set(pulses, &timer, output, section);
    }
    if let Some(hold) = &timer.hold {
        for output in plain.filter(|one| one.wired.wires.len() > 1) {
            let sets = section.sets.entry(output.wired.index).or_default();
            if sets.contains(&hold.begin) && !sets.contains(&hold.end) {
                sets.push(hold.end.clone());
            }
        }
    }
    section.outputs.extend(timer.fields);
    Ok(())
}

/// What sets an output when its value comes, at the start, and when the host is silent.
fn set(pulses: &dyn Pulses, timer: &Timer, output: &Output<'_>, section: &mut Section) {
    let Output { wired, at, pwm, pulse, .. } = output;
    let (scalar, bytes) = element(wired, *at);
    let sets = section.sets.entry(wired.index).or_default();
    // All elements of an array change in the same period: either the timer takes no levels until all are written, or
    // it takes all of them at the end.
    if let Some(Hold { begin, .. }) = &timer.hold
        && wired.wires.len() > 1
        && !sets.contains(begin)
    {
        sets.insert(0, begin.clone());
    }
    let apply = pulses.apply(pulse);
    if let Some(apply) = &apply {
        sets.retain(|line| line != apply);
    }
    sets.push(pulses.set(pulse, &format!("pulse_level({scalar}, {bytes})")));
    sets.extend(apply.clone());
    if let Some(failsafe) = pwm.failsafe {
        let mut safe = pulses.set(pulse, &level(failsafe).to_string());
        if let Some(apply) = &apply {
            safe = format!("{safe} {apply}");
        }
        // Before the host speaks it is silent as well, so this is how the output starts.
        section.begins.push(format!("outputs(|outputs| {{ {safe} }});"));
        section.fails.push((wired.index, safe));
    }
}
