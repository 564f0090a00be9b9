//! The runtime tables of a part, independent of any system: how a chip is started, identified, read and written, how
//! its values are coded and filtered.
//!
//! In: a design and one of its parts. Out: a [`PartPlan`] with all decisions made, which a target prints in its
//! language. Where the part is wired is up to the target: a plan names no unit and no pin.

mod bus;
mod filter;
mod message;
mod simple;
mod source;
mod transfers;
mod uses;
mod value;

use sensedsl_model::design::{Design, Device, Part, PartIndex};
use sensedsl_model::protocol::Protocol;
use sensedsl_wire::Direction;

use crate::snake;
pub use bus::{
    BusPlan, CalibrationPlan, CommandPlan, IdentityPlan, InitPlan, OwnBitsPlan, ReadingPlan,
};
pub use filter::{FilterPlan, Number};
pub use message::{ComposePlan, ExchangePlan, FieldCoding, MessageFieldPlan, MessagePlan};
pub use simple::{BridgePlan, FormulaPlan, TrainPlan};
use source::Source;
pub use transfers::TransferPlan;
pub use uses::{uses, uses_in_c};
pub use value::ValuePlan;

/// The tables of one part.
#[derive(Clone, Debug)]
pub struct PartPlan {
    /// The prefix of its names in C: the part's name in snake case.
    pub prefix: String,
    /// The title for people.
    pub title: String,
    /// The tables for register buses, one for each connection to one.
    pub buses: Vec<BusPlan>,
    /// The table for a serial port.
    pub message: Option<MessagePlan>,
    /// Values that a formula computes from an analog one.
    pub formulas: Vec<FormulaPlan>,
    /// Pulse trains of model receivers.
    pub trains: Vec<TrainPlan>,
    /// Values that drive several outputs.
    pub bridges: Vec<BridgePlan>,
    /// Filters of values before they are reported.
    pub filters: Vec<FilterPlan>,
}

impl PartPlan {
    /// Decides the tables of a part; `None` if its values need none, because the hardware delivers them as they are.
    #[must_use]
    pub fn new(design: &Design, index: PartIndex) -> Option<Self> {
        let part = design.part(index)?;
        let plain = Protocol::default();
        let protocol = part.chip.as_ref().unwrap_or(&plain);
        let source = Source { part, protocol, design, index };
        let prefix = snake(&part.name.value);
        let plan = Self {
            title: title(part),
            buses: bus::plans(source, &prefix),
            message: message::plan(source, &prefix),
            formulas: simple::formulas(source),
            trains: simple::trains(source),
            bridges: simple::bridges(source),
            filters: source.devices(|_| true).filter_map(FilterPlan::new).collect(),
            prefix,
        };
        (!plan.is_empty()).then_some(plan)
    }

    /// Whether there is nothing to print.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        let Self { buses, message, formulas, trains, bridges, filters, .. } = self;
        let has_bytes = !buses.is_empty() || message.is_some();
        let has_values = formulas.is_empty() && trains.is_empty() && bridges.is_empty();
        !has_bytes && has_values && filters.is_empty()
    }
}

/// `Imu: mpu6050`
fn title(part: &Part) -> String {
    match &part.driver {
        Some(driver) => format!("{}: {driver}", part.name.value),
        None => part.name.value.clone(),
    }
}

/// Whether software has to convert between the wires of a device and its value: bytes of a bus or a port, the pulse
/// train of a receiver, a formula, the outputs of a bridge.
#[must_use]
pub fn has_coding(device: &Device, part: &Part) -> bool {
    let has_formula = part.chip.as_ref().is_some_and(|protocol| protocol.formula.is_some());
    let is_bytes = device.kind.bytes().is_some();
    let is_computed = has_formula && device.direction == Direction::Sensor;
    is_bytes || device.kind.is_train() || is_computed || device.coding.drive.is_some()
}
