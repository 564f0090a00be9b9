//! `TIMv1`: a timer for each motor, which stops after each pulse until its interrupt has counted the step.

use sensedsl_board::profile::Timer;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_diagnostics::codes::e0506_hardware_limit;
use sensedsl_model::kind::stepper::{Mode, Stepper};
use sensedsl_model::kind::{KindName, Role};
use sensedsl_wire::Direction;

use crate::context::{Context, Drive, PadPlan};
use crate::section::{Apply, Failsafe, Section};
use crate::timers;
use sensedsl_files::{block, templates};
use sensedsl_job::{JobConnection, JobDevice};

templates! {
    s: Motors;
    Tables = "stepper/v1.c.txt";
}

/// The highest tick of the timer, which the core allows.
const TICK_HZ_MAX: u32 = 4_000_000;
/// The greatest divider of a timer's clock.
const DIVIDER_MAX: u32 = 65_536;

#[derive(Default)]
struct Motors {
    motors: Vec<Motor>,
    commands: Vec<Group>,
    positions: Vec<Position>,
}

/// An `up_motor_t`.
struct Motor {
    ident: String,
    /// `Axis.motor at PB4 (TIM3_CH1), PB5`
    place: String,
    driver: String,
    /// The channel, from 0.
    channel: u8,
    tick_hz: u32,
    pulse_ticks: u32,
    speed: u32,
    acceleration: u32,
    is_velocity: bool,
    dir: String,
    is_forward_high: bool,
    /// The line, and the level that lets current in.
    enable: Option<(String, bool)>,
}

/// A device with one motor for each element.
struct Group {
    ident: String,
    name: String,
    motors: Vec<String>,
}

/// A sensor of positions.
struct Position {
    of: Group,
    words: usize,
}

pub(super) fn plan(context: &Context<'_>, diagnostics: &mut Vec<Diagnostic>) -> Section {
    let mut section = Section::default();
    let mut motors = Motors::default();
    for wired in context.connections(KindName::Stepper) {
        pads(context, wired, &mut section, diagnostics);
        let made = motor(context, wired, &mut section, diagnostics);
        motors.motors.extend(made);
    }
    for (device, wires) in timers::devices(context, KindName::Stepper) {
        let group = Group::new(device, &wires);
        if device.device.direction == Direction::Actuator {
            let line = format!("up_motors_set(&{}_motors, value);", group.ident);
            section.applies.push(Apply { field: group.name.clone(), line });
            section.failsafes.push(Failsafe {
                field: None,
                line: format!("up_motors_stop(&{}_motors);", group.ident),
            });
            motors.commands.push(group);
        } else {
            section.polls.push(format!("up_position_poll(&{}_position);", group.ident));
            motors.positions.push(Position { of: group, words: timers::words(device) });
        }
    }
    if !motors.motors.is_empty() {
        section.tables = block(&Tables { s: &motors });
    }
    section
}

/// The pads of a motor: before the host has set it there is no current in it.
fn pads(
    context: &Context<'_>,
    wired: &JobConnection<'_>,
    section: &mut Section,
    diagnostics: &mut Vec<Diagnostic>,
) {
    let Some(own) = wired.connection.kind.stepper() else { return };
    for pad in &wired.pads {
        if pad.role == Role::Step {
            section.pads.extend(context.alternate_pad(pad, Drive::Plain, diagnostics));
            continue;
        }
        let is_high =
            if pad.role == Role::Dir { own.is_forward_high } else { own.enabled == Some(false) };
        let plan = context.pad(pad, "PAL_MODE_OUTPUT_PUSHPULL", diagnostics);
        section.pads.extend(plan.map(|plan| PadPlan { is_high, ..plan }));
    }
}

fn motor(
    context: &Context<'_>,
    wired: &JobConnection<'_>,
    section: &mut Section,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<Motor> {
    let own = wired.connection.kind.stepper()?;
    let channel = timers::channel(context, wired.pad(Role::Step)?)?;
    let tick_hz = tick(context, wired, channel.timer, diagnostics)?;
    let line = |role| wired.pad(role).and_then(|pad| context.line(&pad.pin.name));
    let (driver, switches) = context.names.pwm(channel.timer);
    let ident = wired.ident.clone();
    section.switches.extend(switches);
    section.clocks.insert(channel.timer.clock.clone());
    section.guards.push(timers::divides(channel.timer, tick_hz));
    section.guards.push(timers::has_channels(channel.timer, channel.number));
    section.starts.extend([
        format!("(void)pwmStart(&{driver}, &{ident}_config);"),
        format!("up_motor_start(&{ident}_motor);"),
    ]);
    Some(Motor {
        place: wired.place(),
        channel: channel.number.saturating_sub(1),
        driver,
        tick_hz,
        pulse_ticks: pulse_ticks(own, tick_hz),
        speed: own.speed,
        acceleration: own.acceleration,
        is_velocity: own.mode == Mode::Velocity,
        dir: line(Role::Dir)?,
        is_forward_high: own.is_forward_high,
        enable: line(Role::Enable).zip(own.enabled),
        ident,
    })
}

/// The ticks of a pulse, rounded up.
fn pulse_ticks(own: &Stepper, tick_hz: u32) -> u32 {
    let ticks = (u64::from(own.pulse_us) * u64::from(tick_hz)).div_ceil(1_000_000);
    u32::try_from(ticks).unwrap_or(u32::MAX)
}

/// The highest tick that a divider of the timer's clock makes.
fn tick(
    context: &Context<'_>,
    wired: &JobConnection<'_>,
    timer: &Timer,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<u32> {
    let span = wired.part.name.span;
    let mut refuse = |message: &str| {
        let help = "choose another timer with `unit`";
        diagnostics.push(e0506_hardware_limit::hardware_limit(span, message, help));
    };
    let clock_hz = context.chibios.clocks_hz.get(&timer.clock).copied().unwrap_or(0);
    let found = ticks(clock_hz);
    if found.is_none() {
        let name = &timer.name;
        refuse(&format!("{name} makes no tick of 4 MHz or less of its clock of {clock_hz} Hz"));
    }
    found
}

fn ticks(clock_hz: u32) -> Option<u32> {
    let least = clock_hz.div_ceil(TICK_HZ_MAX).max(1);
    let mut dividers = (least..=DIVIDER_MAX).filter(|divider| clock_hz.is_multiple_of(*divider));
    dividers.next().map(|divider| clock_hz / divider).filter(|hz| *hz > 0)
}

impl Group {
    fn new(device: &JobDevice<'_>, wires: &[&JobConnection<'_>]) -> Self {
        Self {
            ident: device.ident.clone(),
            name: device.name().to_owned(),
            motors: wires.iter().map(|wire| wire.ident.clone()).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::ticks;

    #[test]
    fn the_tick_is_the_highest_that_the_core_allows() {
        let cases = [
            (84_000_000, Some(4_000_000)),
            (168_000_000, Some(4_000_000)),
            (72_000_000, Some(4_000_000)),
            (170_000_000, Some(3_400_000)),
            (3_000_000, Some(3_000_000)),
            (0, None),
        ];
        for (clock_hz, tick_hz) in cases {
            assert_eq!(ticks(clock_hz), tick_hz, "{clock_hz}");
        }
    }
}
