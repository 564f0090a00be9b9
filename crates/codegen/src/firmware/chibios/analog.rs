//! Analog sensors: one conversion group for each unit, cycle time and priority.

use std::collections::{BTreeMap, BTreeSet};

use sensedsl_board::profile::Cycles;
use sensedsl_board::signal::{Function, UnitName};
use sensedsl_model::kind::{Kind, Role};
use sensedsl_timing::{depth, sampling};

use super::context::{Context, PadPlan, Wired, pad};
use super::tasks::Cycle;

/// All analog sensors.
#[derive(Clone, Debug)]
pub(super) struct AnalogPlan {
    /// Driver objects in use.
    pub(super) drivers: Vec<String>,
    pub(super) groups: Vec<GroupPlan>,
}

/// One conversion group.
#[derive(Clone, Debug)]
pub(super) struct GroupPlan {
    pub(super) index: usize,
    pub(super) driver: String,
    pub(super) cycle: Cycle,
    /// Rows of samples: the largest number any sensor averages, made even.
    pub(super) depth: u16,
    /// In the order of conversion, that is by channel.
    pub(super) sensors: Vec<AnalogSensorPlan>,
    /// Register values, as sums of macros.
    pub(super) smpr1: String,
    pub(super) smpr2: String,
    pub(super) sqr1: String,
    pub(super) sqr2: String,
    pub(super) sqr3: String,
}

/// One column of a group.
#[derive(Clone, Debug)]
pub(super) struct AnalogSensorPlan {
    pub(super) name: String,
    pub(super) column: usize,
    pub(super) samples: u16,
    pub(super) channel: u8,
    cycles: Cycles,
}

pub(super) fn plan(context: &Context<'_>, pads: &mut Vec<PadPlan>) -> AnalogPlan {
    let mut classes: BTreeMap<(UnitName, Cycle), Vec<AnalogSensorPlan>> = BTreeMap::new();
    for wired in &context.devices {
        let Some((unit, sensor)) = sensor(context, wired) else { continue };
        pads.extend(context.pin(wired, Role::In).map(|pin| pad(pin, "PAL_MODE_INPUT_ANALOG")));
        let cycle = context.cycle(unit.as_str(), wired);
        classes.entry((unit, cycle)).or_default().push(sensor);
    }
    let mut drivers = BTreeSet::new();
    let mut groups = Vec::new();
    for ((unit, cycle), mut sensors) in classes {
        let adc = context.profile.adcs.iter().find(|adc| adc.name == unit.as_str());
        let Some(adc) = adc else { continue };
        drivers.insert((unit, adc.driver.clone()));
        sensors.sort_by_key(|sensor| sensor.channel);
        for (column, sensor) in sensors.iter_mut().enumerate() {
            sensor.column = column;
        }
        groups.push(GroupPlan::new(groups.len(), adc.driver.clone(), cycle, sensors));
    }
    AnalogPlan { drivers: drivers.into_iter().map(|(_, driver)| driver).collect(), groups }
}

fn sensor(context: &Context<'_>, wired: &Wired<'_>) -> Option<(UnitName, AnalogSensorPlan)> {
    let Kind::Analog(analog) = &wired.device.kind else { return None };
    let usage = context.wire(wired, Role::In)?.usage(context.board)?;
    let Function::Adc { channel, .. } = usage.signal.function() else { return None };
    let cycles = sampling(&context.profile.adc, analog.sampling_cycles)?;
    let sensor = AnalogSensorPlan {
        name: wired.device.name.value.clone(),
        column: 0,
        samples: analog.samples,
        channel: *channel,
        cycles,
    };
    Some((UnitName::new(wired.wiring.unit.as_deref()?), sensor))
}

impl GroupPlan {
    fn new(index: usize, driver: String, cycle: Cycle, sensors: Vec<AnalogSensorPlan>) -> Self {
        let sample = |register: u8, sensor: &AnalogSensorPlan| {
            let AnalogSensorPlan { channel, cycles, .. } = sensor;
            format!("ADC_SMPR{register}_SMP_AN{channel}(ADC_SAMPLE_{cycles})")
        };
        let samples = |register: u8| {
            // Inputs from 10 on have their times in the first register.
            let own = sensors.iter().filter(|sensor| (sensor.channel >= 10) == (register == 1));
            sum(own.map(|sensor| sample(register, sensor)))
        };
        let sequence = |register: u8, places: std::ops::RangeInclusive<usize>| {
            let own = sensors.iter().filter(|sensor| places.contains(&(sensor.column + 1)));
            let own = own.map(|AnalogSensorPlan { column, channel, .. }| {
                format!("ADC_SQR{register}_SQ{}_N(ADC_CHANNEL_IN{channel})", column + 1)
            });
            own.collect::<Vec<_>>()
        };
        let count = format!("ADC_SQR1_NUM_CH({}U)", sensors.len());
        Self {
            index,
            driver,
            cycle,
            depth: depth(sensors.iter().map(|sensor| sensor.samples)),
            smpr1: samples(1),
            smpr2: samples(2),
            sqr1: sum(std::iter::once(count).chain(sequence(1, 13..=16))),
            sqr2: sum(sequence(2, 7..=12).into_iter()),
            sqr3: sum(sequence(3, 1..=6).into_iter()),
            sensors,
        }
    }

    /// For a comment.
    pub(super) fn names(&self) -> String {
        let names: Vec<&str> = self.sensors.iter().map(|sensor| sensor.name.as_str()).collect();
        names.join(", ")
    }
}

/// Macros or-ed together, a line each; `0U` when there is none.
fn sum(terms: impl Iterator<Item = String>) -> String {
    let terms: Vec<String> = terms.collect();
    if terms.is_empty() { "0U".to_owned() } else { terms.join(" |\n             ") }
}
