//! The tables of a part for the runtime in Rust, from the same plan that the C tables are printed
//! from.

use sense_rt::{
    Bridge, ChipTable, Compose, FilterTable, Formula, Item, MessageField, MessageTable, Schema,
    TrainConfig,
};
use sensedsl_job::part::{PartPlan, TrainPlan};
use sensedsl_twin::tables::{self, kept};
use sensedsl_wire::Direction;

use super::library::Unit;

/// The tables of a device besides those of its part.
#[derive(Clone, Copy, Default)]
pub struct Own {
    pub filter: Option<&'static FilterTable>,
    pub formula: Option<(Formula, &'static [i32], u8)>,
    pub train: Option<TrainConfig>,
    pub bridge: Option<Bridge>,
    /// A value in a CAN frame.
    pub can: Option<MessageField>,
    /// A message with the value.
    pub compose: Option<Compose>,
}

/// All tables of a unit.
pub struct Tables {
    pub schema: &'static Schema,
    pub chip: Option<&'static ChipTable>,
    pub message: Option<&'static MessageTable>,
    pub exchanges: Vec<sense_rt::Exchange>,
    pub own: Vec<Own>,
}

fn train(plan: &TrainPlan) -> TrainConfig {
    TrainConfig {
        tick_hz: plan.tick_hz,
        gap_ticks: u32::try_from(plan.gap_ticks).unwrap(),
        min_ticks: u32::try_from(plan.min_ticks).unwrap(),
    }
}

fn own(plan: &PartPlan, name: &str) -> Own {
    let formula_of = plan.formulas.iter().find(|one| one.field == name);
    Own {
        filter: plan
            .filters
            .iter()
            .find(|one| one.field == name)
            .map(|one| kept(tables::filter(one))),
        formula: formula_of
            .map(|one| (tables::formula(one.formula), &*one.parameters.clone().leak(), one.output)),
        train: plan.trains.iter().find(|one| one.field == name).map(train),
        bridge: plan.bridges.iter().find(|one| one.field == name).map(tables::bridge),
        can: None,
        compose: plan
            .message
            .as_ref()
            .and_then(|plan| plan.commands.iter().find(|one| one.field == name))
            .map(tables::compose),
    }
}

impl Tables {
    pub fn new(unit: &Unit) -> Self {
        let items = unit.devices().map(|device| Item {
            id: device.id.value,
            scalar: tables::scalar(device.value.value.scalar),
            count: u16::try_from(device.value.value.count()).unwrap(),
            direction: match device.direction {
                Direction::Sensor => sense_rt::Direction::ToHost,
                Direction::Actuator => sense_rt::Direction::ToBoard,
            },
        });
        let schema = kept(Schema {
            items: items.collect::<Vec<_>>().leak(),
            hash: 0,
            stamp: false,
            checksum: sense_rt::Checksum::None,
        });
        let names: Vec<String> = unit.devices().map(|device| device.name.value.clone()).collect();
        let index =
            |name: &str| u16::try_from(names.iter().position(|one| one == name).unwrap()).unwrap();
        let plan = super::program::plan(unit);
        let plan = plan.as_ref();
        let bus = plan.and_then(|plan| plan.buses.first());
        let table = bus.map(|bus| kept(tables::chip(bus, index)));
        if let (Some(bus), Some(table)) = (bus, table) {
            assert_eq!(table.work_bytes(schema), bus.work_bytes, "the work buffer of {names:?}");
        }
        let port = plan.and_then(|plan| plan.message.as_ref());
        Self {
            schema,
            chip: table,
            message: port
                .filter(|port| !port.fields.is_empty())
                .map(|port| kept(tables::message(port, index))),
            exchanges: port
                .map(|port| port.exchanges.iter().map(|one| tables::exchange(one, index)).collect())
                .unwrap_or_default(),
            own: unit
                .devices()
                .map(|device| {
                    let own = plan.map_or(Own::default(), |plan| own(plan, &device.name.value));
                    Own { can: tables::in_frame(0, device), ..own }
                })
                .collect(),
        }
    }
}
