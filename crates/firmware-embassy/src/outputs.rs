//! What the host sets: pins, pulse widths, voltages. All are in one static, so that a frame sets them at once.

use std::collections::BTreeMap;

use sensedsl_board::pin::PinName;
use sensedsl_board::signal::{Function, TimerLine};
use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::kind::digital::Digital;
use sensedsl_model::kind::pwm::Pwm;
use sensedsl_model::kind::{KindName, Role};
use sensedsl_wire::Direction;

use super::context::{Context, Wired, scalar};
use super::hal::{Hal, Speed};
use super::lack::{self, Printed};
use super::section::{Field, Section};
use super::{bridge, rp};
use sensedsl_job::JobConnection;
use sensedsl_job::snake;

pub(super) fn plan(context: &Context<'_>, diagnostics: &mut Vec<Diagnostic>) -> Section {
    let mut section = Section::default();
    // Some belong to no device: their part needs them at a fixed level.
    for wire in context.connections(KindName::Digital) {
        let made = pin(context, wire, &mut section);
        context.tell(wire.part, made, diagnostics);
    }
    for wired in actuators(context, KindName::Digital) {
        let made = digital(&wired, &mut section);
        context.tell(wired.first.part, made, diagnostics);
    }
    pwm(context, &mut section, diagnostics);
    for wired in actuators(context, KindName::Dac) {
        let made = dac(context, &wired, &mut section);
        context.tell(wired.first.part, made, diagnostics);
    }
    bridge::plan(context, &mut section, diagnostics);
    section
}

/// The actuators of a kind.
fn actuators<'a>(context: &Context<'a>, kind: KindName) -> Vec<Wired<'a>> {
    let all = context.wired(kind).into_iter();
    all.filter(|one| one.device.device.direction == Direction::Actuator).collect()
}

/// The bits of an element of the value that has come.
pub(super) fn element(wired: &Wired<'_>, at: usize) -> (String, String) {
    let value = wired.device.device.value.value;
    let start = at * value.scalar.size_bytes();
    (scalar(value.scalar), format!("value.get({start}..).unwrap_or_default()"))
}

/// The output of a pin; inputs have none.
fn pin(context: &Context<'_>, wire: &JobConnection<'_>, section: &mut Section) -> Printed<()> {
    if wire.pad(Role::In).is_some() {
        return Ok(());
    }
    let pad = lack::pad(wire, Role::Out)?;
    let own = lack::kind(wire.connection.kind.digital())?;
    let initial = level_of(own, own.initial);
    section.outputs.push(Field {
        name: wire.ident.clone(),
        comment: wire.place(),
        type_: "Output<'static>".to_owned(),
        make: context.output(&pad.pin.name, initial, Speed::Low),
    });
    Ok(())
}

/// What the host sets of pins.
fn digital(wired: &Wired<'_>, section: &mut Section) -> Printed<()> {
    if bridge::is_bridge(wired) {
        return Ok(());
    }
    for (at, wire) in wired.wires.iter().enumerate() {
        let own = lack::kind(wire.connection.kind.digital())?;
        lack::pad(wire, Role::Out)?;
        let (scalar, bytes) = element(wired, at);
        section.sets.entry(wired.index).or_default().push(format!(
            "outputs.{}.set_level(if {scalar}.load({bytes}) != 0 {{ {} }} else {{ {} }});",
            wire.ident,
            level_of(own, true),
            level_of(own, false)
        ));
    }
    Ok(())
}

/// The level of a pin that is on or off.
pub(super) const fn level_of(own: &Digital, is_on: bool) -> &'static str {
    if is_on == own.active_low { "Level::Low" } else { "Level::High" }
}

/// Outputs of one timer are one object of the HAL.
fn pwm(context: &Context<'_>, section: &mut Section, diagnostics: &mut Vec<Diagnostic>) {
    let mut timers: BTreeMap<&str, Vec<Output<'_>>> = BTreeMap::new();
    for wired in actuators(context, KindName::Pwm) {
        for (at, wire) in wired.wires.iter().copied().enumerate() {
            match Output::new(context, &wired, at, wire) {
                Ok((unit, output)) => timers.entry(unit).or_default().push(output),
                Err(lack) => context.tell(wire.part, Err(lack), diagnostics),
            }
        }
    }
    for (unit, outputs) in timers {
        match context.names.hal {
            Hal::Stm32 => timer(context, unit, &outputs, section),
            Hal::Rp => {
                let made = rp::pwm::slice(context, unit, &outputs, section);
                if let Some(first) = outputs.first() {
                    context.tell(first.wire.part, made, diagnostics);
                }
            }
        }
    }
}

/// One element of a value on its channel.
pub(super) struct Output<'a> {
    pub(super) wired: Wired<'a>,
    pub(super) at: usize,
    pub(super) wire: &'a JobConnection<'a>,
    pub(super) pin: &'a PinName,
    pub(super) pwm: &'a Pwm,
    pub(super) pulse: Pulse,
}

impl<'a> Output<'a> {
    /// With the unit that it is of.
    fn new(
        context: &Context<'_>,
        wired: &Wired<'a>,
        at: usize,
        wire: &'a JobConnection<'a>,
    ) -> Printed<(&'a str, Self)> {
        let pwm = lack::kind(wire.connection.kind.pwm())?;
        let (pulse, pin) = (Pulse::of(context, wire)?, &lack::pad(wire, Role::Out)?.pin.name);
        Ok((lack::unit(wire)?, Self { wired: wired.clone(), at, wire, pin, pwm, pulse }))
    }
}

fn timer(context: &Context<'_>, unit: &str, outputs: &[Output<'_>], section: &mut Section) {
    let Some(first) = outputs.first() else { return };
    let (name, hal) = (snake(unit), context.peripheral(unit));
    let own = |slot: u8| {
        outputs.iter().find(move |one| one.pulse.slot == slot && !one.pulse.is_complement)
    };
    let slot = |slot: u8| match own(slot) {
        Some(one) => format!(
            "Some(hal::timer::simple_pwm::PwmPin::new(p.{}, OutputType::PushPull))",
            one.pin
        ),
        None => "None".to_owned(),
    };
    let slots: Vec<String> = (1..=4).map(slot).collect();
    let places: Vec<String> = outputs.iter().map(|one| one.wire.place()).collect();
    section.outputs.push(Field {
        name,
        comment: format!("{unit}: {}", places.join("; ")),
        type_: format!("hal::timer::simple_pwm::SimplePwm<'static, {hal}>"),
        make: format!(
            "hal::timer::simple_pwm::SimplePwm::new{}(p.{hal}, {}, hz({}), CountingMode::EdgeAlignedUp)",
            context.generics(unit, &[]),
            slots.join(", "),
            first.pwm.frequency_hz
        ),
    });
    for one in outputs.iter().filter(|one| one.pulse.is_complement) {
        complement(context, unit, one, section);
    }
    let plain = outputs.iter().filter(|one| !bridge::is_bridge(&one.wired));
    for Output { wired, at, pwm, pulse, .. } in plain {
        let (scalar, bytes) = element(wired, *at);
        let sets = section.sets.entry(wired.index).or_default();
        // All elements change in the same period: until they are written their timers take nothing over.
        let hold = hold(&hal, true);
        let is_array = wired.wires.len() > 1;
        if is_array && !sets.contains(&hold) {
            sets.insert(0, hold);
        }
        sets.push(pulse.set(&format!("pulse_level({scalar}, {bytes})")));
        if let Some(failsafe) = pwm.failsafe {
            let safe = pulse.set(&level(failsafe).to_string());
            // Until the host speaks it is as silent as later: that is the start as well.
            section.begins.push(format!("outputs(|outputs| {{ {safe} }});"));
            section.fails.push(safe);
        }
    }
    for Output { wired, .. } in outputs.iter().filter(|one| one.wired.wires.len() > 1) {
        let (held, release) = (hold(&hal, true), hold(&hal, false));
        let sets = section.sets.entry(wired.index).or_default();
        if sets.contains(&held) && !sets.contains(&release) {
            sets.push(release);
        }
    }
}

/// The pin of a channel's complement. The HAL has it in a driver that turns each channel on with its complement, which
/// then goes against it; here it is alone, and is set as the channel would be.
fn complement(context: &Context<'_>, unit: &str, one: &Output<'_>, section: &mut Section) {
    let (hal, slot) = (context.peripheral(unit), one.pulse.slot);
    let types = ["'static", &hal, &format!("hal::timer::Ch{slot}")].map(str::to_owned);
    let types = context.generics(unit, &types.each_ref().map(String::as_str));
    let type_ = format!("hal::timer::complementary_pwm::ComplementaryPwmPin{types}");
    section.outputs.push(Field {
        name: format!("{}_ch{slot}n", snake(unit)),
        comment: one.wire.place(),
        make: format!("{type_}::new(p.{}, OutputType::PushPull)", one.pin),
        type_,
    });
}

/// Keeps a timer from taking new levels over, or lets it.
fn hold(hal: &str, is_held: bool) -> String {
    format!("hal::pac::{hal}.cr1().modify(|control| control.set_udis({is_held}));")
}

/// An output of a timer.
pub(super) struct Pulse {
    /// Whose HAL drives it.
    hal: Hal,
    /// The timer's object in `Outputs`.
    name: String,
    /// What the HAL calls the timer.
    timer: String,
    /// The channel.
    pub(super) slot: u8,
    /// It is the complement of the channel.
    is_complement: bool,
    /// Of the pulses for 0 and for the greatest level, and from one to the next.
    min_us: u32,
    max_us: u32,
    period_us: u32,
}

impl Pulse {
    pub(super) fn of(context: &Context<'_>, wire: &JobConnection<'_>) -> Printed<Self> {
        let own = lack::kind(wire.connection.kind.pwm())?;
        let (unit, pad) = (lack::unit(wire)?, lack::pad(wire, Role::Out)?);
        let period_us = 1_000_000 / own.frequency_hz.max(1);
        let whole = own.min_us.is_none() && own.max_us.is_none();
        Ok(Self {
            hal: context.names.hal,
            name: snake(unit),
            timer: context.peripheral(unit),
            slot: lack::channel(pad)?,
            is_complement: matches!(
                pad.usage.map(|usage| usage.signal.function()),
                Some(Function::Timer { line: TimerLine::Inverted, .. })
            ),
            // Shares of the whole period need no microseconds, which may be few.
            min_us: own.min_us.unwrap_or(0),
            max_us: if whole { 1 } else { own.max_us.unwrap_or(period_us) },
            period_us: if whole { 1 } else { period_us },
        })
    }

    /// Sets a level in ten-thousandths.
    pub(super) fn set(&self, level: &str) -> String {
        let Self { name, slot, min_us, max_us, period_us, .. } = self;
        let times = format!("[{min_us}, {max_us}, {period_us}]");
        match self.hal {
            Hal::Stm32 => format!(
                "rt::pwm::set_width(&mut outputs.{name}.ch{slot}(), {times}, {level}); {}",
                self.turn_on()
            ),
            Hal::Rp => format!("outputs.{name}.set({slot}, {times}, {level});"),
        }
    }

    /// Turns the output on.
    fn turn_on(&self) -> String {
        let Self { name, timer, slot, .. } = self;
        if self.is_complement {
            let place = slot - 1;
            format!("hal::pac::{timer}.ccer().modify(|on| on.set_ccne({place}, true));")
        } else {
            format!("outputs.{name}.ch{slot}().enable();")
        }
    }

    /// Turns the output off within the period: what follows must not find the old strength.
    pub(super) fn stop(&self) -> String {
        let Self { name, timer, slot, .. } = self;
        let (bank, place) = ((slot - 1) / 2, (slot - 1) % 2);
        let preload = |is_on| {
            format!(
                "hal::pac::{timer}.ccmr_output({bank}).modify(|mode| mode.set_ocpe({place}, {is_on}));"
            )
        };
        format!(
            "{} outputs.{name}.ch{slot}().set_duty_cycle(0); {} {}",
            preload(false),
            self.turn_on(),
            preload(true)
        )
    }
}

/// A level in ten-thousandths, as the runtime counts.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "it is clamped")]
pub(super) fn level(value: f64) -> u32 {
    value.clamp(0.0, 10_000.0).round() as u32
}

fn dac(context: &Context<'_>, wired: &Wired<'_>, section: &mut Section) -> Printed<()> {
    for (at, wire) in wired.wires.iter().enumerate() {
        let (unit, pad) = (lack::unit(wire)?, lack::pad(wire, Role::Out)?);
        let own = lack::kind(wire.connection.kind.dac())?;
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
        let (scalar, bytes) = element(wired, at);
        let set =
            |value: String| format!("outputs.{ident}.set(hal::dac::Value::Bit12Right({value}))");
        let asked = format!("sense_rt::load_magnitude({scalar}, {bytes}).0.min(4_095) as u16");
        section.sets.entry(wired.index).or_default().push(format!("{};", set(asked)));
        let safe = own.failsafe.map(|safe| set(level(safe).min(4_095).to_string()));
        // Until the host speaks it is as silent as later.
        section.begins.extend(safe.iter().map(|safe| format!("outputs(|outputs| {safe});")));
        section.fails.extend(safe.map(|safe| format!("{safe};")));
    }
    Ok(())
}
