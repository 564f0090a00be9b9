//! What the host sets: pins, pulse widths, voltages. All stand in one static, so that a frame sets them at once.

use std::collections::BTreeMap;

use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::kind::{Kind, KindName, Role};
use sensedsl_wire::Direction;

use super::context::{Context, Wired, channel, scalar};
use super::section::{Field, Section};
use crate::job::JobConnection;
use crate::print::snake;

pub(super) fn plan(context: &Context<'_>, _: &mut Vec<Diagnostic>) -> Section {
    let mut section = Section::default();
    digital(context, &mut section);
    pwm(context, &mut section);
    dac(context, &mut section);
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
    for wired in actuators(context, KindName::Digital) {
        for (at, wire) in wired.wires.iter().enumerate() {
            let (Some(pad), Kind::Digital(own)) = (wire.pad(Role::Out), &wire.connection.kind)
            else {
                continue;
            };
            let level = |on: bool| if on == own.active_low { "Level::Low" } else { "Level::High" };
            let (ident, pin) = (&wire.ident, &pad.pin.name);
            section.outputs.push(Field {
                name: ident.clone(),
                comment: wire.place(),
                type_: "Output<'static>".to_owned(),
                make: format!("Output::new(p.{pin}, {}, Speed::Low)", level(own.initial)),
            });
            let (scalar, bytes) = element(&wired, at);
            section.sets.entry(wired.index).or_default().push(format!(
                "outputs.{ident}.set_level(if {scalar}.load({bytes}) != 0 {{ {} }} else {{ {} }});",
                level(true),
                level(false)
            ));
            section.fails.push(format!("outputs.{ident}.set_level({});", level(own.initial)));
        }
    }
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
    for (wired, at) in outputs {
        let Some(wire) = wired.wires.get(*at) else { continue };
        let (Kind::Pwm(own), Some(slot)) =
            (&wire.connection.kind, wire.pad(Role::Out).and_then(channel))
        else {
            continue;
        };
        let (scalar, bytes) = element(wired, *at);
        let period_us = 1_000_000 / own.frequency_hz.max(1);
        let (min_us, max_us) = (own.min_us.unwrap_or(0), own.max_us.unwrap_or(period_us));
        let set = |level: String| match (own.min_us, own.max_us) {
            (None, None) => format!("set_pulse(&mut outputs.{name}.ch{slot}(), {level}, 10_000);"),
            _ => format!(
                "set_pulse(&mut outputs.{name}.ch{slot}(), {min_us} * 10_000 + {level} * {}, {period_us} * 10_000);",
                max_us.saturating_sub(min_us)
            ),
        };
        section
            .sets
            .entry(wired.index)
            .or_default()
            .push(set(format!("pulse_level({scalar}, {bytes})")));
        if let Some(failsafe) = own.failsafe {
            section.fails.push(set(level(failsafe).to_string()));
        }
    }
    section.runtime.insert("pwm.rs");
    Some(())
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
            if let Kind::Dac(own) = &wire.connection.kind {
                section
                    .fails
                    .extend(own.failsafe.map(|safe| set(level(safe).min(4_095).to_string())));
            }
        }
    }
}
