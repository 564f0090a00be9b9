//! Outputs of timers, and bridges on them.

use std::collections::BTreeMap;

use sensedsl_diagnostics::Diagnostic;
use sensedsl_diagnostics::codes::e0506_hardware_limit;
use sensedsl_files::{block, templates};
use sensedsl_job::{JobConnection, JobDevice};
use sensedsl_model::kind::{KindName, Role};
use sensedsl_model::protocol::Drive;

use crate::context::Context;
use crate::rate::Rate;
use crate::section::{Apply, Cost, Failsafe, Section};

templates! {
    s: Pulses;
    Tables = "pwm.c.txt";
}

#[derive(Default)]
struct Pulses {
    timers: Vec<PulseTimer>,
    actuators: Vec<Actuator>,
    bridges: Vec<Bridge>,
}

/// A timer with outputs.
struct PulseTimer {
    name: String,
    /// Its number.
    number: String,
    is_wide: bool,
    rate: Rate,
    frequency_hz: u32,
}

/// An `up_pwm_output_t`.
struct Output {
    place: String,
    timer: String,
    /// `A`
    channel: char,
    is_wide: bool,
    pin: u8,
    least_ticks: u32,
    greatest_ticks: u32,
}

struct Actuator {
    ident: String,
    name: String,
    outputs: Vec<Output>,
}

struct Bridge {
    ident: String,
    name: String,
    outputs: Vec<Output>,
    inputs: Vec<BridgeInput>,
}

enum BridgeInput {
    /// The index of the output.
    Pwm(usize),
    Pin {
        number: u8,
        is_low_active: bool,
    },
}

impl BridgeInput {
    fn c(&self, ident: &str) -> String {
        match self {
            Self::Pwm(index) => format!("{{.pwm = &{ident}_outputs[{index}]}}"),
            Self::Pin { number, is_low_active } => {
                format!("{{.pin = {number}U, .is_low_active = {is_low_active}}}")
            }
        }
    }
}

pub(crate) fn plan(context: &Context<'_>, diagnostics: &mut Vec<Diagnostic>) -> Section {
    let mut section = Section::default();
    let mut timers: BTreeMap<String, PulseTimer> = BTreeMap::new();
    for wire in context.job.connections(KindName::Pwm) {
        if let Some(number) = context.number(wire, Role::Out) {
            section
                .pads
                .push(format!("digitalWrite({number}, LOW);\n  pinMode({number}, OUTPUT);"));
        }
        if let Some(made) = timer(context, wire, diagnostics) {
            timers.entry(made.name.clone()).or_insert(made);
        }
    }
    let mut pulses = Pulses { timers: timers.into_values().collect(), ..Pulses::default() };
    for one in &pulses.timers {
        section.starts.push(format!("start_timer_{}();", one.number));
    }
    for (device, wires) in context.devices(KindName::Pwm) {
        pulses.device(context, device, &wires, &mut section);
    }
    if !pulses.timers.is_empty() {
        section.headers.push("up_pwm.h");
        section.costs.push(Cost::new("outputs of timers", 0, 900));
        section.tables = block(&Tables { s: &pulses });
    }
    section
}

/// The timer of a wire at the frequency of its outputs; the wiring ensures that it is the same for all.
fn timer(
    context: &Context<'_>,
    wire: &JobConnection<'_>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<PulseTimer> {
    let (timer, _) = context.channel(wire.pad(Role::Out)?)?;
    let frequency_hz = wire.connection.kind.pwm()?.frequency_hz;
    let Some(rate) = Rate::new(context.cpu_hz, timer.bits, frequency_hz) else {
        let message = format!("{} cannot make {frequency_hz} Hz", timer.name);
        let help = "choose another `frequency`, or another timer with `unit`";
        let span = wire.part.name.span;
        diagnostics.push(e0506_hardware_limit::hardware_limit(span, &message, help));
        return None;
    };
    let number = timer.name.trim_start_matches(|c: char| !c.is_ascii_digit()).to_owned();
    let (name, is_wide) = (timer.name.clone(), timer.bits > 8);
    Some(PulseTimer { name, number, is_wide, rate, frequency_hz })
}

impl Pulses {
    fn device(
        &mut self,
        context: &Context<'_>,
        device: &JobDevice<'_>,
        wires: &[&JobConnection<'_>],
        section: &mut Section,
    ) {
        let Some(pwm) = device.device.kind.pwm() else { return };
        let (ident, name) = (device.ident.clone(), device.name().to_owned());
        let drive = device.device.coding.drive;
        let (table, verb) = match drive {
            None => (format!("{ident}_pwm"), "up_pwm_set"),
            Some(_) => (format!("{ident}_bridge"), "up_bridge_set"),
        };
        let line = format!("{verb}(&{table}, value);");
        section.applies.push(Apply { field: name.clone(), line });
        // A host that has not sent anything yet is silent: the start is handled in the same way.
        if let Some(failsafe) = pwm.failsafe {
            let least = if drive.is_some() { -10_000.0 } else { 0.0 };
            let level = failsafe.clamp(least, 10_000.0).round();
            let line = format!("{verb}_level(&{table}, {level});");
            section.starts.push(line.clone());
            section.failsafes.push(Failsafe { field: name.clone(), line });
        }
        match drive {
            None => {
                let outputs = wires.iter().filter_map(|wire| self.output(context, wire)).collect();
                self.actuators.push(Actuator { ident, name, outputs });
            }
            Some(drive) => {
                section.costs.push(Cost::new("bridges", 2, 1_400));
                let (outputs, inputs) = self.bridge(context, wires, drive);
                self.bridges.push(Bridge { ident, name, outputs, inputs });
            }
        }
    }

    fn output(&self, context: &Context<'_>, wire: &JobConnection<'_>) -> Option<Output> {
        let pwm = wire.connection.kind.pwm()?;
        let (timer, channel) = context.channel(wire.pad(Role::Out)?)?;
        let own = self.timers.iter().find(|one| one.name == timer.name)?;
        Some(Output {
            place: wire.place(),
            timer: own.number.clone(),
            channel: char::from(b'A' + channel.saturating_sub(1).min(2)),
            is_wide: own.is_wide,
            pin: context.number(wire, Role::Out)?,
            least_ticks: pwm.min_us.map_or(0, |us| own.rate.ticks(us)),
            greatest_ticks: pwm.max_us.map_or(own.rate.period_ticks, |us| own.rate.ticks(us)),
        })
    }

    /// The outputs of a bridge, and its inputs in the order of its wires, which is the runtime's.
    fn bridge(
        &self,
        context: &Context<'_>,
        wires: &[&JobConnection<'_>],
        drive: Drive,
    ) -> (Vec<Output>, Vec<BridgeInput>) {
        let wanted = match drive {
            Drive::DirectionPins => 3,
            Drive::DirectionPin | Drive::TwoPwm => 2,
        };
        let (mut outputs, mut inputs) = (Vec::new(), Vec::new());
        for wire in wires.iter().take(wanted) {
            if let Some(own) = wire.connection.kind.digital() {
                let pin = |number| BridgeInput::Pin { number, is_low_active: own.active_low };
                inputs.extend(context.number(wire, Role::Out).map(pin));
            } else if let Some(output) = self.output(context, wire) {
                inputs.push(BridgeInput::Pwm(outputs.len()));
                outputs.push(output);
            }
        }
        (outputs, inputs)
    }
}
