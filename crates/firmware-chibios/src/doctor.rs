//! Tables for the self test of the board's wires.

use sensedsl_model::kind::Role;

use super::context::Context;
use sensedsl_job::{JobConnection, Pad};

/// All tables of the self test.
#[derive(Clone, Debug, Default)]
pub(super) struct DoctorPlan {
    /// Wires that are driven or pulled from outside.
    pub(super) inputs: Vec<Input>,
    /// Chips whose state shows whether they work.
    pub(super) chips: Vec<Chip>,
    /// Sensors that count.
    pub(super) edges: Vec<Edges>,
}

/// An `up_input_t`.
#[derive(Clone, Debug)]
pub(super) struct Input {
    /// `IRFront at PB0 (ADC12-IN8)`
    pub(super) title: String,
    pub(super) line: String,
    /// True if it is pulled up by a resistor, not driven.
    pub(super) is_bus: bool,
}

/// An `up_chip_check_t`.
#[derive(Clone, Debug)]
pub(super) struct Chip {
    pub(super) title: String,
    /// The prefix of the names of its tables.
    pub(super) prefix: String,
}

/// An `up_edges_t`.
#[derive(Clone, Debug)]
pub(super) struct Edges {
    pub(super) title: String,
    /// The device's name.
    pub(super) field: String,
}

pub(super) fn plan(context: &Context<'_>) -> DoctorPlan {
    let mut plan = DoctorPlan::default();
    for one in &context.job.connections {
        plan.inputs.extend(one.pads.iter().filter_map(|pad| input(context, one, pad)));
        let counts = one.connection.kind.name().spec().triggers_itself;
        let device = context.device_of(one).filter(|_| counts);
        plan.edges.extend(
            device.map(|device| Edges { title: one.place(), field: device.name().to_owned() }),
        );
    }
    // Devices share the wires of their bus.
    plan.inputs.sort_by(|a, b| a.line.cmp(&b.line));
    plan.inputs.dedup_by(|a, b| a.line == b.line);
    for part in context.job.parts.iter().filter(|one| one.part.chip.is_some()) {
        let own = context.job.connections.iter().filter(|one| one.connection.part == part.index);
        let bus = own.filter_map(|own| Some((context.job.bus_of(own)?, own)));
        plan.chips
            .extend(bus.map(|(bus, own)| Chip { title: own.place(), prefix: bus.prefix.clone() }));
    }
    plan
}

/// A wire that the board can detect to be disconnected. MISO of an SPI device is not driven while the device is not
/// selected.
fn input(context: &Context<'_>, one: &JobConnection<'_>, pad: &Pad<'_>) -> Option<Input> {
    let is_reported = pad.role.is_driven_by_device() && pad.role != Role::Miso;
    let line = context.line(&pad.pin.name).filter(|_| is_reported)?;
    let is_bus = matches!(pad.role, Role::Scl | Role::Sda);
    let signal = pad.usage.map_or("GPIO", |usage| usage.spelled.as_str());
    let name = if is_bus { one.unit.unwrap_or_default() } else { &one.title };
    Some(Input { title: format!("{name} at {} ({signal})", pad.pin.name), line, is_bus })
}
