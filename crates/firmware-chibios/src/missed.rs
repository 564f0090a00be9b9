//! Connections of the wiring that no driver serves: they are reported, so that no device is left out silently.

use sensedsl_board::pin::PinName;
use sensedsl_board::signal::UnitName;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_diagnostics::codes::e0504_no_firmware_target::no_firmware_target;
use sensedsl_timing::refusals_of;

use super::context::{Context, PadPlan};
use super::peripherals::{self, PERIPHERALS};
use super::section::Section;
use sensedsl_job::JobConnection;

/// Reports each connection with a pad that nothing sets up, or with a port that nothing starts. If something was
/// reported before, such as a clock that cannot be made, that is the reason.
pub(super) fn report(
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
        // All wires of a chip or an array give the same report.
        if diagnostics.last() != Some(&report) {
            diagnostics.push(report);
        }
    }
}

/// The part of a connection that nothing serves. A kind without code has been reported as such.
fn missed(
    context: &Context<'_>,
    one: &JobConnection<'_>,
    pads: &[PadPlan],
    sections: &[Section],
) -> Option<String> {
    let kind = one.connection.kind.name();
    let drivers = context.names.drivers.clone();
    let peripheral = PERIPHERALS.iter().find(|peripheral| peripheral.kind == Some(kind))?;
    let is_reported = !peripherals::kinds(&drivers).contains(&kind)
        || (peripheral.lacks)(context.job, one).is_some();
    if is_reported {
        return None;
    }
    let is_set_up = |pin: &PinName| pads.iter().any(|plan| plan.pin == *pin);
    if let Some(pad) = one.pads.iter().find(|pad| !is_set_up(&pad.pin.name)) {
        return Some(format!("the pin {}", pad.pin.name));
    }
    // Only what is sent in bytes has a port, unless the processor makes the bits on a pin.
    one.connection.kind.bytes().filter(|_| one.connection.kind.onewire().is_none())?;
    let Some(unit) = one.unit else { return Some("a unit".to_owned()) };
    let own = context.profile.unit(unit).map_or(unit, |unit| unit.name.as_str());
    let is_started = sections.iter().any(|section| {
        section.units.contains(&UnitName::new(own)) || section.units.contains(&UnitName::new(unit))
    });
    (!is_started).then(|| format!("the unit {own}"))
}
