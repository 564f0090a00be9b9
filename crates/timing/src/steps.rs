//! Steps of motors: the interrupts that they take, and speeds that the processor or the timer cannot carry.

use sensedsl_board::profile::Costs;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_diagnostics::codes::e0627_too_many_steps;
use sensedsl_model::design::DeviceIndex;
use sensedsl_model::kind::stepper::Stepper;
use sensedsl_wire::Direction;

use crate::context::{Context, Wired};
use crate::processor::{Work, core_hz};
use crate::rows::{Count, Part, Row};

/// The name of the row of all steps.
pub(crate) const STEPS: &str = "steps";
/// The part of the processor that the steps of one motor may take: an interrupt that comes before the one ahead of it
/// is over makes the motor slower than it was told to be.
const SHARE_PERCENT: u64 = 70;
/// The microseconds between a pulse and the next one: the interrupt and the direction need them.
const PAUSE_US: u64 = 2;

/// The motors of a board, each element of an array.
fn motors<'c, 'a>(
    context: &'c Context<'a>,
) -> impl Iterator<Item = (&'c Wired<'a>, &'c Stepper)> + use<'c, 'a> {
    let actuators = context.elements.iter();
    let actuators = actuators.filter(|one| one.device.direction == Direction::Actuator);
    actuators.filter_map(|wired| Some((wired, wired.device.kind.stepper()?)))
}

/// A row of interrupts for each motor, at its greatest speed.
pub(crate) fn rows(context: &Context<'_>) -> Vec<Row> {
    let row = |(wired, motor): (&Wired<'_>, &Stepper)| {
        let name = wired.wiring.unit.clone().unwrap_or_else(|| "TIM".to_owned());
        let mut row = Row::new(Part::Interrupts, name, vec![wired.index]);
        row.a_second = Some(Count::Interrupts(motor.speed.into()));
        row
    };
    motors(context).map(row).collect()
}

/// The steps of all motors at their greatest speeds, as a row of the processor's work.
pub(crate) fn thread(
    context: &Context<'_>,
    costs: Option<&Costs>,
    ns: &dyn Fn(u64) -> Option<u64>,
) -> Option<Row> {
    let all: Vec<(DeviceIndex, u64)> =
        motors(context).map(|(wired, motor)| (wired.index, motor.speed.into())).collect();
    if all.is_empty() {
        return None;
    }
    let mut devices: Vec<DeviceIndex> = all.iter().map(|(index, _)| *index).collect();
    devices.dedup();
    let steps: u64 = all.iter().map(|(_, speed)| speed).sum();
    let mut row = Row::new(Part::Thread, STEPS, devices);
    let instructions = costs.map(|costs| steps * u64::from(costs.step));
    row.a_second = instructions.map(Count::Instructions);
    row.busy_ns = instructions.and_then(ns);
    Some(row)
}

/// Reports a motor whose steps come faster than the processor can make them, or than pulses can follow each other.
pub(crate) fn too_fast(
    context: &Context<'_>,
    wired: &Wired<'_>,
    motor: &Stepper,
) -> Option<Diagnostic> {
    let work = Work::of(context);
    let step_ns = work.of_step();
    let by_processor = (step_ns > 0).then(|| 10_000_000 * SHARE_PERCENT / step_ns.max(1));
    let by_pulse = 1_000_000 / (u64::from(motor.pulse_us) + PAUSE_US);
    let most = by_processor.unwrap_or(u64::MAX).min(by_pulse);
    if u64::from(motor.speed) <= most || wired.device.direction != Direction::Actuator {
        return None;
    }
    let (name, speed) = (&wired.device.name.value, motor.speed);
    let why = if most == by_pulse {
        format!("pulses of {} us follow each other at most {most} times a second", motor.pulse_us)
    } else {
        let mhz = core_hz(context).unwrap_or(0) / 1_000_000;
        format!("the processor at {mhz} MHz makes at most {most} steps a second of one motor")
    };
    let message = format!("{name} may make {speed} steps a second, and {why}");
    let help = format!(
        "write `speed = {most};` or less, or set the driver to fewer microsteps: each step then moves the motor farther"
    );
    let at = motor.speed_span.unwrap_or(wired.device.name.span);
    Some(e0627_too_many_steps::too_many_steps(at, &message, &help))
}
