//! Motors behind H-bridges: one value becomes the strength of a pulse and the levels of two pins, or two pulses.

use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::kind::{Kind, KindName, Role};
use sensedsl_model::protocol::Drive;

use super::context::{Context, Wired, scalar};
use super::lack::{self, Printed};
use super::outputs::{Pulse, level_of};
use super::section::{Field, Section};
use sensedsl_job::JobConnection;
use sensedsl_job::part::BridgePlan;

/// Whether the outputs of a device are those of a bridge.
pub(super) fn is_bridge(wired: &Wired<'_>) -> bool {
    wired.device.device.coding.drive.is_some()
}

pub(super) fn plan(
    context: &Context<'_>,
    section: &mut Section,
    diagnostics: &mut Vec<Diagnostic>,
) {
    for wired in context.wired(KindName::Pwm) {
        let mut all = context.job.parts.iter().flat_map(|part| &part.plan.bridges);
        if let Some(plan) = all.find(|plan| plan.field == wired.device.name()) {
            let made = bridge(context, &wired, plan, section);
            context.tell(wired.first.part, made, diagnostics);
        }
    }
}

fn bridge(
    context: &Context<'_>,
    wired: &Wired<'_>,
    plan: &BridgePlan,
    section: &mut Section,
) -> Printed<()> {
    let (ident, upper) = (&wired.device.ident, wired.device.ident.to_uppercase());
    let mode = match plan.drive {
        Drive::DirectionPins => "DirectionPins",
        Drive::TwoPwm => "TwoPwm",
    };
    section.tables.push(format!(
        "pub const {upper}_BRIDGE: sense_rt::Bridge = sense_rt::Bridge {{ mode: sense_rt::BridgeMode::{mode}, full: {} }};",
        plan.full
    ));
    section.outputs.push(Field {
        name: format!("{ident}_bridge"),
        comment: format!("what the outputs of {} do", wired.device.name()),
        type_: "sense_rt::BridgeState".to_owned(),
        make: "sense_rt::BridgeState::NEW".to_owned(),
    });
    // In the order of the runtime's outputs.
    let outputs = context.job.wires_of(wired.device.device);
    let arms = outputs.iter().enumerate().map(|(at, one)| write(context, at, one));
    let arms: String = arms.collect::<Printed<String>>()?;
    section.items.push(format!(
        "/// Gives the outputs of {} what its value asks of each.\n\
         fn drive_{ident}(outputs: &mut Outputs, scalar: Scalar, value: &[u8]) {{\n    \
         for write in tables::{upper}_BRIDGE.drive(&mut outputs.{ident}_bridge, scalar, value).as_slice() {{\n        \
         match write.output {{\n{arms}            _ => {{}}\n        }}\n    }}\n}}",
        wired.device.name()
    ));
    let drive = |scalar: &str, value: &str| format!("drive_{ident}(outputs, {scalar}, {value});");
    let own = scalar(wired.device.device.value.value.scalar);
    section.sets.entry(wired.index).or_default().push(drive(&own, "value"));
    if let Kind::Pwm(pwm) = &wired.device.device.kind
        && let Some(failsafe) = pwm.failsafe
    {
        let safe = drive("Scalar::Int32", &format!("&{}_i32.to_be_bytes()", level(failsafe)));
        // Until the host speaks it is as silent as later: that is the start as well.
        section.begins.push(format!("outputs(|outputs| {{ {safe} }});"));
        section.fails.push(safe);
    }
    Ok(())
}

/// What writes one output.
fn write(context: &Context<'_>, at: usize, wire: &JobConnection<'_>) -> Printed<String> {
    if let Some(own) = wire.connection.kind.digital() {
        lack::pad(wire, Role::Out)?;
        return Ok(format!(
            "            {at} => outputs.{}.set_level(if write.value != 0 {{ {} }} else {{ {} }}),\n",
            wire.ident,
            level_of(own, true),
            level_of(own, false)
        ));
    }
    let pulse = Pulse::of(context, wire)?;
    Ok(format!(
        "            {at} if write.value == 0 => {{ {} }}\n            {at} => {{ {} }}\n",
        pulse.stop(),
        pulse.set("write.value")
    ))
}

/// A level with its direction.
#[expect(clippy::cast_possible_truncation, reason = "it is clamped")]
fn level(value: f64) -> i32 {
    value.clamp(-10_000.0, 10_000.0).round() as i32
}
