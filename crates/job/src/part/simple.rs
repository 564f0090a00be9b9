//! Values that no bus carries: formulas on analog values, pulse trains, bridges.

use sensedsl_model::design::Device;
use sensedsl_model::kind::Kind;
use sensedsl_model::protocol::{Drive, Formula};

use super::source::Source;
use crate::snake;

/// An interval longer than this starts a pulse train.
const TRAIN_GAP_US: u64 = 2_700;
/// An interval shorter than this is a disturbance.
const TRAIN_MIN_US: u64 = 500;
/// The value of an output that is always on.
const FULL: u32 = 10_000;

/// A value that a formula computes from an analog one.
#[derive(Clone, Debug)]
pub struct FormulaPlan {
    /// The device's name.
    pub field: String,
    /// The device's identifier in code.
    pub ident: String,
    /// The runtime's formula.
    pub formula: Formula,
    /// The output of the formula that it is.
    pub output: u8,
    /// The formula's constants.
    pub parameters: Vec<i32>,
}

/// An `up_ppm_config_t`.
#[derive(Clone, Debug)]
pub struct TrainPlan {
    /// The device's name.
    pub field: String,
    /// The device's identifier in code.
    pub ident: String,
    /// The clock of the timer.
    pub tick_hz: u32,
    /// A longer interval starts a train.
    pub gap_ticks: u64,
    /// A shorter one is a disturbance.
    pub min_ticks: u64,
}

/// An `up_drive_t`.
#[derive(Clone, Debug)]
pub struct BridgePlan {
    /// The device's name.
    pub field: String,
    /// The device's identifier in code.
    pub ident: String,
    /// How the outputs are driven.
    pub drive: Drive,
    /// The greatest magnitude.
    pub full: u32,
    /// The part's connections, in the order of the runtime's outputs.
    pub outputs: Vec<String>,
}

pub(super) fn formulas(source: Source<'_>) -> Vec<FormulaPlan> {
    let devices = source.devices(Kind::is_sampled);
    let plan = |device: &Device| {
        Some(FormulaPlan {
            field: device.name.value.clone(),
            ident: snake(&device.name.value),
            formula: source.protocol.formula?,
            output: device.coding.output?.number,
            parameters: source.protocol.parameters.clone(),
        })
    };
    devices.filter_map(plan).collect()
}

pub(super) fn trains(source: Source<'_>) -> Vec<TrainPlan> {
    let devices = source.devices(Kind::is_train);
    let plan = |device: &Device| {
        let tick_hz = device.kind.icu()?.tick_hz;
        let ticks = |us: u64| u64::from(tick_hz) * us / 1_000_000;
        Some(TrainPlan {
            field: device.name.value.clone(),
            ident: snake(&device.name.value),
            tick_hz,
            gap_ticks: ticks(TRAIN_GAP_US),
            min_ticks: ticks(TRAIN_MIN_US),
        })
    };
    devices.filter_map(plan).collect()
}

pub(super) fn bridges(source: Source<'_>) -> Vec<BridgePlan> {
    let plan = |device: &Device| {
        let names = device.connections.iter().filter_map(|index| {
            let connection = source.design.connection(*index)?;
            connection.name.clone()
        });
        Some(BridgePlan {
            field: device.name.value.clone(),
            ident: snake(&device.name.value),
            drive: device.coding.drive?,
            full: FULL,
            outputs: names.collect(),
        })
    };
    source.devices(|_| true).filter_map(plan).collect()
}
