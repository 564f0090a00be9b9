//! What the wiring has and no driver took: it is told, so that no device is left out in silence.

use sensedsl_board::pin::PinName;
use sensedsl_board::signal::UnitName;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_diagnostics::codes::e0504_no_firmware_target::no_firmware_target;
use sensedsl_model::kind::KindName;
use sensedsl_timing::refusals_of;

use super::context::{Context, PadPlan};
use super::section::Section;
use sensedsl_job::JobConnection;

/// Tells each connection with a pad that nothing sets up, or with a port that nothing starts. Where something else was
/// told already, a clock that cannot be made among it, that is why.
pub(super) fn tell(
    context: &Context<'_>,
    pads: &[PadPlan],
    sections: &[Section],
    diagnostics: &mut Vec<Diagnostic>,
) {
    let job = context.job;
    if !diagnostics.is_empty() || !refusals_of(job.design, job.board, job.wiring).is_empty() {
        return;
    }
    for one in &context.job.connections {
        let Some(what) = missed(context, one, pads, sections) else { continue };
        let (name, board) = (&one.part.name, &context.job.board.name.value);
        let why = format!("`{}` needs {what}, which no driver of its firmware has", name.value);
        let report = no_firmware_target(name.span, board, &why);
        // All wires of a chip or an array have one thing to say.
        if diagnostics.last() != Some(&report) {
            diagnostics.push(report);
        }
    }
}

/// What of a connection nothing serves. What there is no code for is told as that.
fn missed(
    context: &Context<'_>,
    one: &JobConnection<'_>,
    pads: &[PadPlan],
    sections: &[Section],
) -> Option<String> {
    let kind = one.connection.kind.name();
    let drivers = context.names.drivers.clone();
    let peripheral = super::PERIPHERALS.iter().find(|peripheral| peripheral.kind == Some(kind))?;
    let is_told = !super::section::kinds(&drivers).contains(&kind)
        || (peripheral.lacks)(context.job, one).is_some();
    if is_told {
        return None;
    }
    let is_set_up = |pin: &PinName| pads.iter().any(|plan| plan.pin == *pin);
    if let Some(pad) = one.pads.iter().find(|pad| !is_set_up(&pad.pin.name)) {
        return Some(format!("the pin {}", pad.pin.name));
    }
    let has_port = match kind {
        KindName::I2c | KindName::Spi | KindName::Uart | KindName::Can => true,
        KindName::Analog
        | KindName::Icu
        | KindName::Encoder
        | KindName::Digital
        | KindName::Pwm
        | KindName::Dac => false,
    };
    if !has_port {
        return None;
    }
    let Some(unit) = one.unit else { return Some("a unit".to_owned()) };
    let own = context.profile.unit(unit).map_or(unit, |unit| unit.name.as_str());
    let is_started = sections.iter().any(|section| {
        section.units.contains(&UnitName::new(own)) || section.units.contains(&UnitName::new(unit))
    });
    (!is_started).then(|| format!("the unit {own}"))
}
