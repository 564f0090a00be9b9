//! `TIMv1`: a driver object for each timer with outputs, whichever devices use them.

use std::collections::BTreeMap;

use sensedsl_board::profile::Timer;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_diagnostics::codes::e0506_hardware_limit;
use sensedsl_model::kind::pwm::Pwm;
use sensedsl_model::kind::{KindName, Role};
use sensedsl_model::protocol::Drive as Bridged;

use super::rate::Rate;
use crate::context::{Context, Drive};
use crate::names::Setting;
use crate::section::{Apply, Failsafe, Section};
use crate::timers::{self, Channel};
use sensedsl_files::{block, templates};
use sensedsl_job::snake;
use sensedsl_job::{JobConnection, JobDevice};

templates! {
    s: Pulses;
    Tables = "pwm/v1.c.txt";
}

#[derive(Default)]
struct Pulses {
    timers: Vec<PulseTimer>,
    actuators: Vec<Actuator>,
    bridges: Vec<Bridge>,
}

/// One timer with all its outputs.
struct PulseTimer {
    /// `tim3`
    ident: String,
    name: String,
    driver: String,
    rate: Rate,
    frequency_hz: u32,
    channels: Vec<ChannelPlan>,
}

struct ChannelPlan {
    /// The channel, from 0.
    index: u8,
    /// `Esc[0] at PA6 (TIM3_CH1)`
    place: String,
    mode: &'static str,
    /// The identifier of the connection.
    ident: String,
}

/// An `up_pwm_output_t`.
struct Output {
    driver: String,
    channel: u8,
    least_ticks: u32,
    greatest_ticks: u32,
}

/// A device with one output for each element.
struct Actuator {
    ident: String,
    name: String,
    outputs: Vec<Output>,
}

/// A device whose value drives the inputs of an H-bridge.
struct Bridge {
    ident: String,
    name: String,
    outputs: Vec<Output>,
    /// The inputs in the order of the runtime's outputs.
    inputs: Vec<BridgeInput>,
}

enum BridgeInput {
    /// The index of the output.
    Pwm(usize),
    Pin {
        line: String,
        is_low_active: bool,
    },
}

impl BridgeInput {
    fn c(&self, ident: &str) -> String {
        match self {
            Self::Pwm(index) => format!("{{.pwm = &{ident}_outputs[{index}]}}"),
            Self::Pin { line, is_low_active: false } => format!("{{.line = {line}}}"),
            Self::Pin { line, .. } => format!("{{.line = {line}, .is_low_active = true}}"),
        }
    }
}

pub(super) fn plan(context: &Context<'_>, diagnostics: &mut Vec<Diagnostic>) -> Section {
    let mut section = Section::default();
    let mut pulses = Pulses::default();
    let mut timers: BTreeMap<&str, PulseTimer> = BTreeMap::new();
    for wired in context.connections(KindName::Pwm) {
        let Some(pad) = wired.pad(Role::Out) else { continue };
        section.pads.extend(context.alternate_pad(pad, Drive::Plain, diagnostics));
        let Some(channel) = timers::channel(context, pad) else { continue };
        let Some(pwm) = wired.connection.kind.pwm() else { continue };
        let name = channel.timer.name.as_str();
        if !timers.contains_key(name) {
            let made = timer(context, (wired, pwm), channel.timer, &mut section, diagnostics);
            timers.extend(made.map(|made| (name, made)));
        }
        let Some(timer) = timers.get_mut(name) else { continue };
        section.guards.push(timers::has_channels(channel.timer, channel.number));
        timer.channels.push(ChannelPlan::new(wired, &channel));
    }
    for timer in timers.values_mut() {
        timer.channels.sort_by_key(|one| one.index);
    }
    pulses.timers = timers.into_values().collect();
    for (device, wires) in timers::devices(context, KindName::Pwm) {
        pulses.device(context, device, &wires, &mut section);
    }
    // Motors take the same driver.
    let has_motors = context.connections(KindName::Stepper).next().is_some();
    let is_used = has_motors || !pulses.timers.is_empty();
    let truth = if is_used { "TRUE" } else { "FALSE" };
    section.switch = Some(Setting::new("HAL_USE_PWM", truth));
    if !pulses.timers.is_empty() {
        section.tables = block(&Tables { s: &pulses });
    }
    section
}

/// A timer at the frequency of its outputs; the wiring ensures that it is the same for all.
fn timer(
    context: &Context<'_>,
    (wired, pwm): (&JobConnection<'_>, &Pwm),
    timer: &Timer,
    section: &mut Section,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<PulseTimer> {
    let clock_hz = context.chibios.clocks_hz.get(&timer.clock).copied().unwrap_or(0);
    let frequency_hz = pwm.frequency_hz;
    let Some(rate) = Rate::new(clock_hz, frequency_hz) else {
        let message =
            format!("{} cannot make {frequency_hz} Hz of its clock of {clock_hz} Hz", timer.name);
        let help = "choose another `frequency`, or another timer with `unit`";
        let span = wired.part.name.span;
        diagnostics.push(e0506_hardware_limit::hardware_limit(span, &message, help));
        return None;
    };
    let (driver, switches) = context.names.pwm(timer);
    let ident = snake(&timer.name);
    section.switches.extend(switches);
    section.clocks.insert(timer.clock.clone());
    section.guards.push(timers::divides(timer, rate.tick_hz));
    section.starts.push(format!("(void)pwmStart(&{driver}, &{ident}_pwm_config);"));
    let name = timer.name.clone();
    Some(PulseTimer { ident, name, driver, rate, frequency_hz, channels: Vec::new() })
}

impl ChannelPlan {
    fn new(wired: &JobConnection<'_>, channel: &Channel<'_>) -> Self {
        Self {
            index: channel.number.saturating_sub(1),
            place: wired.place(),
            mode: if channel.is_inverted {
                "PWM_COMPLEMENTARY_OUTPUT_ACTIVE_HIGH"
            } else {
                "PWM_OUTPUT_ACTIVE_HIGH"
            },
            ident: wired.ident.clone(),
        }
    }
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
        let (table, verb) = match device.device.coding.drive {
            None => (format!("{ident}_pwm"), "up_pwm_set"),
            Some(_) => (format!("{ident}_bridge"), "up_bridge_set"),
        };
        let line = format!("{verb}(&{table}, value);");
        section.applies.push(Apply { field: name.clone(), line });
        // A host that has not sent anything yet is silent: the start is handled in the same way.
        if let Some(failsafe) = pwm.failsafe {
            let least = if device.device.coding.drive.is_some() { -10_000.0 } else { 0.0 };
            let level = failsafe.clamp(least, 10_000.0).round();
            let unit = if device.device.coding.drive.is_some() { "" } else { "U" };
            let line = format!("{verb}_level(&{table}, {level}{unit});");
            section.starts.push(line.clone());
            section.failsafes.push(Failsafe { field: Some(name.clone()), line });
        }
        match device.device.coding.drive {
            None => {
                let outputs = wires.iter().filter_map(|wire| self.output(wire)).collect();
                self.actuators.push(Actuator { ident, name, outputs });
            }
            Some(drive) => {
                let (outputs, inputs) = self.bridge(context, wires, drive);
                self.bridges.push(Bridge { ident, name, outputs, inputs });
            }
        }
    }

    fn output(&self, wired: &JobConnection<'_>) -> Option<Output> {
        let pwm = wired.connection.kind.pwm()?;
        let on = |timer: &PulseTimer| {
            let mut channels = timer.channels.iter();
            let channel = channels.find(|one| one.ident == wired.ident)?;
            let Rate { period_ticks, .. } = timer.rate;
            Some(Output {
                driver: timer.driver.clone(),
                channel: channel.index,
                least_ticks: pwm.min_us.map_or(0, |us| timer.rate.ticks(us)),
                greatest_ticks: pwm.max_us.map_or(period_ticks, |us| timer.rate.ticks(us)),
            })
        };
        self.timers.iter().find_map(on)
    }

    /// The outputs of a bridge, and its inputs in the order of its wires, which is the runtime's.
    fn bridge(
        &self,
        context: &Context<'_>,
        wires: &[&JobConnection<'_>],
        drive: Bridged,
    ) -> (Vec<Output>, Vec<BridgeInput>) {
        let wanted = match drive {
            Bridged::DirectionPins => 3,
            Bridged::DirectionPin | Bridged::TwoPwm => 2,
        };
        let (mut outputs, mut inputs) = (Vec::new(), Vec::new());
        for wired in wires.iter().take(wanted) {
            if let Some(own) = wired.connection.kind.digital() {
                let line = wired.pad(Role::Out).and_then(|pad| context.line(&pad.pin.name));
                let pin = |line| BridgeInput::Pin { line, is_low_active: own.active_low };
                inputs.extend(line.map(pin));
            } else if let Some(output) = self.output(wired) {
                inputs.push(BridgeInput::Pwm(outputs.len()));
                outputs.push(output);
            }
        }
        (outputs, inputs)
    }
}
