//! Motors behind H-bridges: one value sets a pulse and the levels of two pins, or two pulses.

use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::kind::{Kind, KindName, Role};
use sensedsl_model::protocol::Drive;

use super::actuators::level_of;
use super::context::{Context, Wired, scalar};
use super::hal::contract::outputs::Pulses;
use super::item::{BridgeItem, Constant, Item};
use super::missing::{self, Printed};
use super::pwm::pulse;
use super::section::{Field, Section};
use sensedsl_job::JobConnection;
use sensedsl_job::part::BridgePlan;

pub(super) fn plan(
    context: &Context<'_>,
    pulses: &dyn Pulses,
    section: &mut Section,
    diagnostics: &mut Vec<Diagnostic>,
) {
    for wired in context.wired(KindName::Pwm) {
        let mut all = context.job.parts.iter().flat_map(|part| &part.plan.bridges);
        if let Some(plan) = all.find(|plan| plan.field == wired.device.name()) {
            let made = bridge(context, pulses, &wired, plan, section);
            context.report(wired.first.part, made, diagnostics);
        }
    }
}

/// A device with the function that drives its outputs.
fn bridge(
    context: &Context<'_>,
    pulses: &dyn Pulses,
    wired: &Wired<'_>,
    plan: &BridgePlan,
    section: &mut Section,
) -> Printed<()> {
    let (ident, upper) = (&wired.device.ident, wired.device.ident.to_uppercase());
    let mode = match plan.drive {
        Drive::DirectionPins => "DirectionPins",
        Drive::DirectionPin => "DirectionPin",
        Drive::TwoPwm => "TwoPwm",
    };
    section.tables.push(Constant::Line(format!(
        "pub const {upper}_BRIDGE: sense_rt::Bridge = sense_rt::Bridge {{ mode: sense_rt::BridgeMode::{mode}, full: {} }};",
        plan.full
    )));
    section.outputs.push(Field {
        name: format!("{ident}_bridge"),
        comment: format!("what the outputs of {} do", wired.device.name()),
        type_: "sense_rt::BridgeState".to_owned(),
        make: "sense_rt::BridgeState::NEW".to_owned(),
    });
    // The wires are in the order of the runtime's outputs.
    let outputs = context.job.wires_of(wired.device.device);
    let mut arms = Vec::new();
    for (at, one) in outputs.iter().enumerate() {
        arms.extend(write(context, pulses, at, one)?);
    }
    section.items.push(Item::Bridge(BridgeItem {
        name: wired.device.name().to_owned(),
        ident: ident.clone(),
        constant: upper,
        arms,
    }));
    let drive = |scalar: &str, value: &str| format!("drive_{ident}(outputs, {scalar}, {value});");
    let own = scalar(wired.device.device.value.value.scalar);
    section.sets.entry(wired.index).or_default().push(drive(&own, "value"));
    if let Kind::Pwm(pwm) = &wired.device.device.kind
        && let Some(failsafe) = pwm.failsafe
    {
        let safe = drive("Scalar::Int32", &format!("&{}_i32.to_be_bytes()", level(failsafe)));
        // Before the host speaks it is silent as well, so this is how the outputs start.
        section.begins.push(format!("outputs(|outputs| {{ {safe} }});"));
        section.fails.push((wired.index, safe));
    }
    Ok(())
}

/// The arms that write one output: patterns of its number and value, and an expression each.
fn write(
    context: &Context<'_>,
    pulses: &dyn Pulses,
    at: usize,
    wire: &JobConnection<'_>,
) -> Printed<Vec<(String, String)>> {
    if let Some(own) = wire.connection.kind.digital() {
        missing::pad(wire, Role::Out)?;
        let (high, low) = (level_of(own, true), level_of(own, false));
        let level = format!("if write.value != 0 {{ {high} }} else {{ {low} }}");
        return Ok(vec![(at.to_string(), format!("outputs.{}.set_level({level})", wire.ident))]);
    }
    let pulse = pulse(context, wire)?;
    let set = [Some(pulses.set(&pulse, "write.value")), pulses.apply(&pulse)];
    let set: Vec<String> = set.into_iter().flatten().collect();
    Ok(vec![
        (format!("{at} if write.value == 0"), format!("{{ {} }}", pulses.stop(&pulse))),
        (at.to_string(), format!("{{ {} }}", set.join(" "))),
    ])
}

/// A level with its direction, in ten-thousandths.
#[expect(clippy::cast_possible_truncation, reason = "it is clamped")]
fn level(value: f64) -> i32 {
    value.clamp(-10_000.0, 10_000.0).round() as i32
}
