//! What the host sets: pins, pulses, voltages. All are in one static, so that a frame sets them at once.

use std::collections::BTreeMap;

use sensedsl_board::signal::Function;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::kind::{KindName, Role};

use super::actuators::{actuators, element, is_bridge, level, level_of};
use super::context::{Context, Wired};
use super::hal::contract::Drivers;
use super::hal::contract::outputs::{Dac, Pins, Speed};
use super::missing::{self, Printed};
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
        let all = actuators(context, KindName::Dac);
        let fields = converters(context, dac, &all, &mut section);
        for wired in &all {
            let made = fields.as_ref().map_err(Clone::clone);
            let made = made.and_then(|fields| voltage(dac, wired, fields, &mut section));
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

/// The field of each analog output, by its wire. The two channels of a converter are one field.
fn converters<'a>(
    context: &Context<'_>,
    dac: &dyn Dac,
    all: &[Wired<'a>],
    section: &mut Section,
) -> Printed<BTreeMap<&'a str, String>> {
    let mut units: BTreeMap<&str, BTreeMap<u8, &JobConnection<'_>>> = BTreeMap::new();
    for wire in all.iter().flat_map(|wired| wired.wires.iter().copied()) {
        let usage = missing::pad(wire, Role::Out)?.usage;
        let channel = match usage.map(|usage| usage.signal.function()) {
            Some(Function::Dac { channel, .. }) => *channel,
            _ => 1,
        };
        units.entry(missing::unit(wire)?).or_default().insert(channel, wire);
    }
    let pin = |wire: &JobConnection<'a>| Ok(&missing::pad(wire, Role::Out)?.pin.name);
    let mut fields = BTreeMap::new();
    for (unit, channels) in units {
        let own: Vec<&JobConnection<'_>> = channels.into_values().collect();
        let field = match own.as_slice() {
            [first, second] => {
                let made = dac.channels(context, unit, [pin(first)?, pin(second)?]);
                let name = snake(unit);
                fields.insert(first.ident.as_str(), format!("{name}.0"));
                fields.insert(second.ident.as_str(), format!("{name}.1"));
                Field::of(name, format!("{unit}: {}; {}", first.place(), second.place()), made)
            }
            [first, ..] => {
                fields.insert(first.ident.as_str(), first.ident.clone());
                let made = dac.channel(context, unit, pin(first)?);
                Field::of(first.ident.clone(), first.place(), made)
            }
            [] => continue,
        };
        section.outputs.push(field);
    }
    Ok(fields)
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
        let field = fields.get(wire.ident.as_str()).map_or(wire.ident.as_str(), String::as_str);
        let (scalar, bytes) = element(wired, at);
        let asked = format!("sense_rt::load_magnitude({scalar}, {bytes}).0.min(4_095) as u16");
        let set = dac.set(field, &asked);
        section.sets.entry(wired.index).or_default().push(format!("{set};"));
        if let Some(failsafe) = own.failsafe {
            let safe = dac.set(field, &level(failsafe).min(4_095).to_string());
            // Before the host speaks it is silent as well, so this is how the output starts.
            section.begins.push(format!("outputs(|outputs| {safe});"));
            section.fails.push(format!("{safe};"));
        }
    }
    Ok(())
}
