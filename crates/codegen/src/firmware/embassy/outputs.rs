//! What the host sets: pins, pulse widths, voltages. All stand in one static, so that a frame sets them at once.

use std::collections::BTreeMap;

use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::kind::digital::Digital;
use sensedsl_model::kind::{Kind, KindName, Role};
use sensedsl_wire::Direction;

use super::context::{Context, Wired, channel, scalar};
use super::section::{Field, Section};
use super::{bridge, contacts};
use crate::job::JobConnection;
use crate::print::snake;

pub(super) fn plan(context: &Context<'_>, _: &mut Vec<Diagnostic>) -> Section {
    let mut section = Section::default();
    digital(context, &mut section);
    pwm(context, &mut section);
    dac(context, &mut section);
    bridge::plan(context, &mut section);
    section
}

/// The actuators of a kind.
fn actuators<'a>(context: &Context<'a>, kind: KindName) -> Vec<Wired<'a>> {
    let all = context.wired(kind).into_iter();
    all.filter(|one| one.device.device.direction == Direction::Actuator).collect()
}

/// The bits of an element of the value that has come.
fn element(wired: &Wired<'_>, at: usize) -> (String, String) {
    let value = wired.device.device.value.value;
    let start = at * value.scalar.size_bytes();
    (scalar(value.scalar), format!("value.get({start}..).unwrap_or_default()"))
}

fn digital(context: &Context<'_>, section: &mut Section) {
    // Some are of no device: a part has them at their level for good.
    for wire in context.job.connections(KindName::Digital) {
        let (Some(pad), Some(own)) = (wire.pad(Role::Out), contacts::digital(wire)) else {
            continue;
        };
        section.outputs.push(Field {
            name: wire.ident.clone(),
            comment: wire.place(),
            type_: "Output<'static>".to_owned(),
            make: format!(
                "Output::new(p.{}, {}, Speed::Low)",
                pad.pin.name,
                level_of(own, own.initial)
            ),
        });
    }
    let actuators = actuators(context, KindName::Digital).into_iter();
    for wired in actuators.filter(|wired| !bridge::is_bridge(wired)) {
        for (at, wire) in wired.wires.iter().enumerate() {
            let Some(own) = contacts::digital(wire) else { continue };
            let (scalar, bytes) = element(&wired, at);
            section.sets.entry(wired.index).or_default().push(format!(
                "outputs.{}.set_level(if {scalar}.load({bytes}) != 0 {{ {} }} else {{ {} }});",
                wire.ident,
                level_of(own, true),
                level_of(own, false)
            ));
        }
    }
}

/// The level of a pin that is on or off.
pub(super) const fn level_of(own: &Digital, is_on: bool) -> &'static str {
    if is_on == own.active_low { "Level::Low" } else { "Level::High" }
}

/// Outputs of one timer are one object of the HAL.
fn pwm(context: &Context<'_>, section: &mut Section) {
    let mut timers: BTreeMap<&str, Vec<(Wired<'_>, usize)>> = BTreeMap::new();
    let devices = actuators(context, KindName::Pwm);
    for wired in &devices {
        for (at, wire) in wired.wires.iter().enumerate() {
            let Some(unit) = wire.unit else { continue };
            let one =
                Wired { index: wired.index, device: wired.device, wires: wired.wires.clone() };
            timers.entry(unit).or_default().push((one, at));
        }
    }
    for (unit, outputs) in timers {
        timer(context, unit, &outputs, section);
    }
}

fn timer(
    context: &Context<'_>,
    unit: &str,
    outputs: &[(Wired<'_>, usize)],
    section: &mut Section,
) -> Option<()> {
    let (name, hal) = (snake(unit), context.peripheral(unit));
    let wires = || outputs.iter().filter_map(|(wired, at)| wired.wires.get(*at).copied());
    let on = |slot: u8| wires().find(|one| one.pad(Role::Out).and_then(channel) == Some(slot));
    let slot = |slot: u8| match on(slot).and_then(|one| one.pad(Role::Out)) {
        Some(pad) => format!(
            "Some(hal::timer::simple_pwm::PwmPin::new(p.{}, OutputType::PushPull))",
            pad.pin.name
        ),
        None => "None".to_owned(),
    };
    let slots: Vec<String> = (1..=4).map(slot).collect();
    let places: Vec<String> = wires().map(JobConnection::place).collect();
    let Kind::Pwm(first) = &wires().next()?.connection.kind else { return None };
    section.outputs.push(Field {
        name: name.clone(),
        comment: format!("{unit}: {}", places.join("; ")),
        type_: format!("hal::timer::simple_pwm::SimplePwm<'static, {hal}>"),
        make: format!(
            "hal::timer::simple_pwm::SimplePwm::new(p.{hal}, {}, hz({}), CountingMode::EdgeAlignedUp)",
            slots.join(", "),
            first.frequency_hz
        ),
    });
    let plain = outputs.iter().filter(|(wired, _)| !bridge::is_bridge(wired));
    for (wired, at) in plain {
        let Some(wire) = wired.wires.get(*at) else { continue };
        let (Some(pulse), Kind::Pwm(own)) = (Pulse::of(context, wire), &wire.connection.kind)
        else {
            continue;
        };
        let (scalar, bytes) = element(wired, *at);
        let sets = section.sets.entry(wired.index).or_default();
        // All elements change in the same period: until they are written their timers take nothing over.
        let hold = |is_held| {
            format!("hal::pac::{hal}.cr1().modify(|control| control.set_udis({is_held}));")
        };
        let is_array = wired.wires.len() > 1;
        if is_array && !sets.contains(&hold(true)) {
            sets.insert(0, hold(true));
        }
        sets.push(pulse.set(&format!("pulse_level({scalar}, {bytes})")));
        if let Some(failsafe) = own.failsafe {
            let safe = pulse.set(&level(failsafe).to_string());
            // Until the host speaks it is as silent as later: that is the start as well.
            section.begins.push(format!("outputs(|outputs| {{ {safe} }});"));
            section.fails.push(safe);
        }
    }
    for (wired, _) in outputs.iter().filter(|(wired, _)| wired.wires.len() > 1) {
        let release = format!("hal::pac::{hal}.cr1().modify(|control| control.set_udis(false));");
        let held = release.replace("false", "true");
        let sets = section.sets.entry(wired.index).or_default();
        if sets.contains(&held) && !sets.contains(&release) {
            sets.push(release);
        }
    }
    section.runtime.insert("pwm.rs");
    Some(())
}

/// An output of a timer.
pub(super) struct Pulse {
    /// The timer's object in `Outputs`.
    name: String,
    /// What the HAL calls the timer.
    hal: String,
    slot: u8,
    /// Of the pulses for 0 and for the greatest level, and from one to the next.
    min_us: u32,
    max_us: u32,
    period_us: u32,
}

impl Pulse {
    pub(super) fn of(context: &Context<'_>, wire: &JobConnection<'_>) -> Option<Self> {
        let Kind::Pwm(own) = &wire.connection.kind else { return None };
        let period_us = 1_000_000 / own.frequency_hz.max(1);
        let whole = own.min_us.is_none() && own.max_us.is_none();
        Some(Self {
            name: snake(wire.unit?),
            hal: context.peripheral(wire.unit?),
            slot: channel(wire.pad(Role::Out)?)?,
            // Shares of the whole period need no microseconds, which may be few.
            min_us: own.min_us.unwrap_or(0),
            max_us: if whole { 1 } else { own.max_us.unwrap_or(period_us) },
            period_us: if whole { 1 } else { period_us },
        })
    }

    /// Sets a level in ten-thousandths.
    pub(super) fn set(&self, level: &str) -> String {
        let Self { name, slot, min_us, max_us, period_us, .. } = self;
        format!(
            "set_pulse(&mut outputs.{name}.ch{slot}(), [{min_us}, {max_us}, {period_us}], {level});"
        )
    }

    /// Turns the output off within the period: what follows must not find the old strength.
    pub(super) fn stop(&self) -> String {
        let Self { name, hal, slot, .. } = self;
        let (bank, place) = ((slot - 1) / 2, (slot - 1) % 2);
        let preload = |is_on| {
            format!(
                "hal::pac::{hal}.ccmr_output({bank}).modify(|mode| mode.set_ocpe({place}, {is_on}));"
            )
        };
        format!(
            "{} outputs.{name}.ch{slot}().set_duty_cycle(0); outputs.{name}.ch{slot}().enable(); {}",
            preload(false),
            preload(true)
        )
    }
}

/// A level in ten-thousandths, as the runtime counts.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "it is clamped")]
fn level(value: f64) -> u32 {
    value.clamp(0.0, 10_000.0).round() as u32
}

fn dac(context: &Context<'_>, section: &mut Section) {
    for wired in actuators(context, KindName::Dac) {
        for (at, wire) in wired.wires.iter().enumerate() {
            let (Some(unit), Some(pad)) = (wire.unit, wire.pad(Role::Out)) else { continue };
            let ident = &wire.ident;
            section.outputs.push(Field {
                name: ident.clone(),
                comment: wire.place(),
                type_: "hal::dac::DacChannel<'static, hal::mode::Blocking>".to_owned(),
                make: format!(
                    "hal::dac::DacChannel::new_blocking(p.{}, p.{})",
                    context.peripheral(unit),
                    pad.pin.name
                ),
            });
            let (scalar, bytes) = element(&wired, at);
            let set = |value: String| {
                format!("outputs.{ident}.set(hal::dac::Value::Bit12Right({value}));")
            };
            section.sets.entry(wired.index).or_default().push(set(format!(
                "sense_rt::load_magnitude({scalar}, {bytes}).0.min(4_095) as u16"
            )));
            let Kind::Dac(own) = &wire.connection.kind else { continue };
            let safe = own.failsafe.map(|safe| set(level(safe).min(4_095).to_string()));
            // Until the host speaks it is as silent as later.
            section.begins.extend(
                safe.iter().map(|safe| format!("outputs(|outputs| {safe});").replace(";);", ");")),
            );
            section.fails.extend(safe);
        }
    }
}
