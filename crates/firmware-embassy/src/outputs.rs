//! What the host sets: pins, pulses, voltages. All are in one static, so that a frame sets them at once.

use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::kind::{KindName, Role};

use super::actuators::{actuators, element, is_bridge, level, level_of};
use super::context::{Context, Wired};
use super::hal::contract::Drivers;
use super::hal::contract::outputs::{Dac, Pins, Speed};
use super::missing::{self, Printed};
use super::section::{Field, Section};
use super::{bridge, pwm};
use sensedsl_job::JobConnection;

pub(super) fn plan(
    context: &Context<'_>,
    drivers: &dyn Drivers,
    diagnostics: &mut Vec<Diagnostic>,
) -> Section {
    let mut section = Section::default();
    // Some wires belong to no device: the part needs them at a fixed level.
    for wire in context.connections(KindName::Digital) {
        let made = pin(drivers.pins(), wire, &mut section);
        context.report(wire.part, made, diagnostics);
    }
    for wired in actuators(context, KindName::Digital) {
        let made = digital(&wired, &mut section);
        context.report(wired.first.part, made, diagnostics);
    }
    if let Some(pulses) = drivers.pulses() {
        pwm::plan(context, pulses, &mut section, diagnostics);
    }
    if let Some(dac) = drivers.dac() {
        for wired in actuators(context, KindName::Dac) {
            let made = voltage(context, dac, &wired, &mut section);
            context.report(wired.first.part, made, diagnostics);
        }
    }
    if let Some(pulses) = drivers.pulses() {
        bridge::plan(context, pulses, &mut section, diagnostics);
    }
    section
}

/// The output of a pin; inputs have none.
fn pin(pins: &dyn Pins, wire: &JobConnection<'_>, section: &mut Section) -> Printed<()> {
    if wire.pad(Role::In).is_some() {
        return Ok(());
    }
    let pad = missing::pad(wire, Role::Out)?;
    let own = missing::kind(wire.connection.kind.digital())?;
    let initial = level_of(own, own.initial);
    section.outputs.push(Field {
        name: wire.ident.clone(),
        comment: wire.place(),
        type_: "Output<'static>".to_owned(),
        make: pins.output(&pad.pin.name, initial, Speed::Low),
    });
    Ok(())
}

/// What sets the pins of a device.
fn digital(wired: &Wired<'_>, section: &mut Section) -> Printed<()> {
    if is_bridge(wired) {
        return Ok(());
    }
    for (at, wire) in wired.wires.iter().enumerate() {
        let own = missing::kind(wire.connection.kind.digital())?;
        missing::pad(wire, Role::Out)?;
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

/// The analog outputs of a device with what sets them.
fn voltage(
    context: &Context<'_>,
    dac: &dyn Dac,
    wired: &Wired<'_>,
    section: &mut Section,
) -> Printed<()> {
    for (at, wire) in wired.wires.iter().enumerate() {
        let (unit, pad) = (missing::unit(wire)?, missing::pad(wire, Role::Out)?);
        let own = missing::kind(wire.connection.kind.dac())?;
        let ident = &wire.ident;
        let made = dac.channel(context, unit, &pad.pin.name);
        section.outputs.push(Field::of(ident.clone(), wire.place(), made));
        let (scalar, bytes) = element(wired, at);
        let asked = format!("sense_rt::load_magnitude({scalar}, {bytes}).0.min(4_095) as u16");
        let set = dac.set(ident, &asked);
        section.sets.entry(wired.index).or_default().push(format!("{set};"));
        if let Some(failsafe) = own.failsafe {
            let safe = dac.set(ident, &level(failsafe).min(4_095).to_string());
            // Before the host speaks it is silent as well, so this is how the output starts.
            section.begins.push(format!("outputs(|outputs| {safe});"));
            section.fails.push(format!("{safe};"));
        }
    }
    Ok(())
}
