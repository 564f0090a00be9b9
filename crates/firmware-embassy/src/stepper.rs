//! Stepper motors: a static for each, which its interrupt and the reporter share.

use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::kind::stepper::{Mode, Stepper};
use sensedsl_model::kind::{KindName, Role};
use sensedsl_wire::Direction;

use super::actuators::element;
use super::context::{Context, Wired, scalar};
use super::filter;
use super::hal::contract::Drivers;
use super::hal::contract::motors::{MotorTimer, Motors};
use super::hal::contract::outputs::{Pins, Speed};
use super::item::{Handler, Item};
use super::missing::{self, Printed};
use super::section::{Field, Section};
use sensedsl_job::JobConnection;

/// How often a motor that stands is reported.
const REPEAT_MS: u32 = 1_000;

pub(super) fn plan(
    context: &Context<'_>,
    drivers: &dyn Drivers,
    diagnostics: &mut Vec<Diagnostic>,
) -> Section {
    let mut section = Section::default();
    let Some(motors) = drivers.motors() else { return section };
    for wire in context.connections(KindName::Stepper) {
        let made = motor(context, (motors, drivers.pins()), wire, &mut section);
        context.report(wire.part, made, diagnostics);
    }
    for wired in context.wired(KindName::Stepper) {
        if wired.device.device.direction == Direction::Sensor {
            tell(context, &wired, &mut section);
        } else {
            set(&wired, &mut section);
        }
    }
    section
}

/// The static of a motor.
fn name(wire: &JobConnection<'_>) -> String {
    format!("{}_MOTOR", wire.ident.to_uppercase())
}

/// A motor with its timer, its pins and the handler of its interrupt.
fn motor(
    context: &Context<'_>,
    (motors, pins): (&dyn Motors, &dyn Pins),
    wire: &JobConnection<'_>,
    section: &mut Section,
) -> Printed<()> {
    let own = missing::kind(wire.connection.kind.stepper())?;
    let MotorTimer { made, channel, interrupt } = motors.timer(context, wire)?;
    let (ident, held) = (&wire.ident, name(wire));
    section.fields.push(Field::of(ident.clone(), wire.place(), made));
    let mut pin = |role: Role, end: &str, is_high: bool| {
        let pad = missing::pad(wire, role)?;
        let level = if is_high { "Level::High" } else { "Level::Low" };
        section.fields.push(Field {
            name: format!("{ident}_{end}"),
            comment: wire.place(),
            type_: "Output<'static>".to_owned(),
            make: pins.output(&pad.pin.name, level, Speed::Low),
        });
        Ok(())
    };
    pin(Role::Dir, "dir", own.is_forward_high)?;
    if let Some(enabled) = own.enabled {
        pin(Role::Enable, "enable", !enabled)?;
    }
    section
        .items
        .push(Item::Line(format!("static {held}: rt::stepper::SharedMotor = rt::stepper::new();")));
    let handler = format!("{}_STEPS", ident.to_uppercase());
    section.bind(&interrupt, format!("crate::{handler}"));
    section.items.push(Item::Handler(Handler {
        doc: format!("The steps of {}", wire.title),
        name: handler,
        named_as: "the device",
        interrupt: interrupt.clone(),
        calls: vec![format!("rt::stepper::on_step(&{held});")],
    }));
    section.begins.push(start(own, wire, channel));
    section.begins.push("// Its handler is there.".to_owned());
    section.begins.push(format!("unsafe {{ interrupt::{interrupt}.enable() }};"));
    section.hushes.push(format!("rt::stepper::stop(&{held});"));
    Ok(())
}

/// The statement that starts a motor. The runtime sets the tick of its timer.
fn start(own: &Stepper, wire: &JobConnection<'_>, channel: u8) -> String {
    let ident = &wire.ident;
    let enable = match own.enabled {
        Some(level) => format!("Some((wiring.{ident}_enable, {level}))"),
        None => "None".to_owned(),
    };
    format!(
        "rt::stepper::start(&{}, wiring.{ident}, rt::stepper::Plan {{ channel: {channel}, pulse_us: {}, dir: \
         wiring.{ident}_dir, is_forward_high: {}, enable: {enable}, config: sense_rt::MotorConfig {{ tick_hz: 0, \
         speed: {}, acceleration: {}, is_velocity: {} }} }});",
        name(wire),
        own.pulse_us,
        own.is_forward_high,
        own.speed,
        own.acceleration,
        own.mode == Mode::Velocity
    )
}

/// What the host sets.
fn set(wired: &Wired<'_>, section: &mut Section) {
    for (at, wire) in wired.wires.iter().enumerate() {
        let (scalar, bytes) = element(wired, at);
        let set = format!("rt::stepper::set(&{}, {scalar}, {bytes});", name(wire));
        section.sets.entry(wired.index).or_default().push(set);
    }
}

/// The reporter tells where motors are, when they have moved.
fn tell(context: &Context<'_>, wired: &Wired<'_>, section: &mut Section) {
    let filter = filter::polled(context, wired.index, section);
    let (ident, value) = (&wired.device.ident, wired.device.device.value.value);
    let count = wired.wires.len();
    let reads: Vec<String> =
        wired.wires.iter().map(|wire| format!("rt::stepper::position(&{})", name(wire))).collect();
    section.states.push(format!("let mut {ident}_reported = [0; {count}];"));
    section.states.push(format!("let mut {ident}_repeat = Repeat::NEW;"));
    let store = format!(
        "store_count({}, i64::from(one), value.get_mut(at * {}..).unwrap_or_default());",
        scalar(value.scalar),
        value.scalar.size_bytes()
    );
    section.polls.push(vec![
        format!("let positions = [{}];", reads.join(", ")),
        format!(
            "if {ident}_repeat.is_due(positions != {ident}_reported, {REPEAT_MS}, now_ms()) {{"
        ),
        format!("    {ident}_reported = positions;"),
        format!("    let mut value = [0; {}];", value.size_bytes()),
        format!("    for (at, one) in positions.into_iter().enumerate() {{ {store} }}"),
        format!(
            "    BOARD.report({filter}, tables::{}, Outcome::Fresh, &mut value);",
            wired.device.ident.to_uppercase()
        ),
        "}".to_owned(),
    ]);
}
