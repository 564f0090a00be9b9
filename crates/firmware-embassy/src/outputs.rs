//! What the host sets: pins, pulses, voltages. All are in one static, so that a frame sets them at once.

use std::collections::BTreeMap;

use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::kind::{KindName, Role};

use super::actuators::{actuators, element, is_bridge, level, level_of};
use super::context::{Context, Wired};
use super::hal::contract::Drivers;
use super::hal::contract::outputs::{Dac, Pins, Speed};
use super::missing::{self, Missing, Printed};
use super::section::{Field, Section};
use super::{bridge, pwm};
use sensedsl_job::{JobConnection, snake};

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
        voltages(context, dac, &mut section, diagnostics);
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

/// The wires of each digital-analog converter, by the numbers of its outputs.
type Converters<'a> = BTreeMap<&'a str, BTreeMap<u8, &'a JobConnection<'a>>>;

/// Puts an output with its converter.
fn place<'a>(wire: &'a JobConnection<'a>, all: &mut Converters<'a>) -> Printed<()> {
    let output = missing::converter_output(missing::pad(wire, Role::Out)?)?;
    all.entry(missing::unit(wire)?).or_default().insert(output, wire);
    Ok(())
}

/// The field of a converter, with what each of its wires is there. Both outputs are one field.
fn converter<'a>(
    context: &Context<'_>,
    dac: &dyn Dac,
    (unit, outputs): (&str, &BTreeMap<u8, &'a JobConnection<'a>>),
    section: &mut Section,
) -> Printed<Vec<(&'a str, String)>> {
    let pin = |wire: &JobConnection<'a>| Ok(&missing::pad(wire, Role::Out)?.pin.name);
    let own: Vec<&'a JobConnection<'a>> = outputs.values().copied().collect();
    let (field, reached) = match own.as_slice() {
        [one] => {
            let made = dac.channel(context, unit, pin(one)?);
            let field = Field::of(one.ident.clone(), one.place(), made);
            (field, vec![(one.ident.as_str(), one.ident.clone())])
        }
        [first, second] => {
            let made = dac.channels(context, unit, [pin(first)?, pin(second)?]);
            let (name, places) =
                (snake(unit), format!("{unit}: {}; {}", first.place(), second.place()));
            let reached = vec![
                (first.ident.as_str(), format!("{name}.0")),
                (second.ident.as_str(), format!("{name}.1")),
            ];
            (Field::of(name, places, made), reached)
        }
        _ => return Err(Missing::unit(format!("{} outputs of {unit}", own.len()))),
    };
    section.outputs.push(field);
    Ok(reached)
}

/// All analog outputs, with what sets them.
fn voltages(
    context: &Context<'_>,
    dac: &dyn Dac,
    section: &mut Section,
    diagnostics: &mut Vec<Diagnostic>,
) {
    let all = actuators(context, KindName::Dac);
    let mut converters = Converters::new();
    for wire in all.iter().flat_map(|wired| wired.wires.iter().copied()) {
        context.report(wire.part, place(wire, &mut converters), diagnostics);
    }
    let mut fields = BTreeMap::new();
    for (unit, outputs) in &converters {
        let made = converter(context, dac, (unit, outputs), section);
        let first = outputs.values().next().map(|wire| wire.part);
        match (made, first) {
            (Ok(reached), _) => fields.extend(reached),
            (Err(missing), Some(part)) => context.report(part, Err(missing), diagnostics),
            (Err(_), None) => {}
        }
    }
    for wired in &all {
        context.report(wired.first.part, voltage(dac, wired, &fields, section), diagnostics);
    }
}

/// What sets the analog outputs of a device.
fn voltage(
    dac: &dyn Dac,
    wired: &Wired<'_>,
    fields: &BTreeMap<&str, String>,
    section: &mut Section,
) -> Printed<()> {
    for (at, wire) in wired.wires.iter().enumerate() {
        let own = missing::kind(wire.connection.kind.dac())?;
        // A wire without a field was reported.
        let Some(field) = fields.get(wire.ident.as_str()) else { continue };
        let (scalar, bytes) = element(wired, at);
        let asked = format!("sense_rt::load_magnitude({scalar}, {bytes}).0.min(4_095) as u16");
        let set = dac.set(field, &asked);
        section.sets.entry(wired.index).or_default().push(format!("{set};"));
        if let Some(failsafe) = own.failsafe {
            let safe = dac.set(field, &level(failsafe).min(4_095).to_string());
            // Before the host speaks it is silent as well, so this is how the output starts.
            section.begins.push(format!("outputs(|outputs| {safe});"));
            section.fails.push((wired.index, format!("{safe};")));
        }
    }
    Ok(())
}
