//! `ADCv2`: one conversion group for each unit, cycle time and priority.

use std::collections::{BTreeMap, BTreeSet};

use askama::Template;
use sensedsl_board::profile::Cycles;
use sensedsl_board::signal::{Function, UnitName};
use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::kind::{Kind, KindName, Role};
use sensedsl_timing::{depth, sampling};

use crate::firmware::chibios::context::Context;
use crate::firmware::chibios::names::Setting;
use crate::firmware::chibios::section::{STACK_BYTES, Section, Work};
use crate::job::{Cycle, JobDevice};
use crate::print::block;

/// All analog sensors.
#[derive(Template)]
#[template(path = "firmware/chibios/adc/v2.c.txt", escape = "none")]
struct Tables<'a> {
    s: &'a Analog,
}

struct Analog {
    /// Driver objects in use.
    drivers: Vec<String>,
    groups: Vec<Group>,
}

/// One conversion group.
struct Group {
    index: usize,
    unit: UnitName,
    driver: String,
    cycle: Cycle,
    /// Rows of samples: the largest number any sensor averages, made even.
    depth: u16,
    /// In the order of conversion, that is by channel.
    sensors: Vec<Sensor>,
    /// Register values, as sums of macros.
    smpr1: String,
    smpr2: String,
    sqr1: String,
    sqr2: String,
    sqr3: String,
}

/// One column of a group.
struct Sensor {
    name: String,
    id: u8,
    column: usize,
    samples: u16,
    channel: u8,
    cycles: Cycles,
}

pub(super) fn plan(context: &Context<'_>, diagnostics: &mut Vec<Diagnostic>) -> Section {
    let mut section = Section::default();
    let mut classes: BTreeMap<(UnitName, Cycle), Vec<Sensor>> = BTreeMap::new();
    for wired in context.devices(KindName::Analog) {
        let Some((unit, sensor)) = sensor(context, wired) else { continue };
        let pad = wired.pad(Role::In);
        let pad = pad.and_then(|pad| context.pad(pad, "PAL_MODE_INPUT_ANALOG", diagnostics));
        section.pads.extend(pad);
        section.units.insert(unit.clone());
        classes.entry((unit, wired.cycle)).or_default().push(sensor);
    }
    let has_any = !classes.is_empty();
    let truth = if has_any { "TRUE" } else { "FALSE" };
    section.switch = Some(Setting::new("HAL_USE_ADC", truth));
    section.hal = ["ADC_USE_WAIT", "ADC_USE_MUTUAL_EXCLUSION"]
        .map(|name| Setting::new(name, "TRUE"))
        .to_vec();
    if !has_any {
        return section;
    }
    let analog = Analog::new(context, classes);
    section.clocks.extend(context.profile.adc.clock.clone());
    // The converters' clock is told, so that it is what their times were computed with.
    let clock = context.names.adcs.clock_option.as_ref();
    section.mcu.extend(clock.map(|[option, value]| Setting::new(option, value)));
    section.work = analog.groups.iter().map(Group::work).collect();
    let drivers = analog.drivers.iter();
    section.starts = drivers.map(|one| format!("(void)adcStart(&{one}, NULL);")).collect();
    section.tables = block(&Tables { s: &analog });
    section
}

fn sensor(context: &Context<'_>, wired: &JobDevice<'_>) -> Option<(UnitName, Sensor)> {
    let Kind::Analog(analog) = &wired.device.kind else { return None };
    let usage = wired.pad(Role::In)?.usage?;
    let Function::Adc { channel, .. } = usage.signal.function() else { return None };
    let cycles = sampling(&context.profile.adc, analog.sampling_cycles)?;
    let sensor = Sensor {
        name: wired.name().to_owned(),
        id: wired.device.id.value,
        column: 0,
        samples: analog.samples,
        channel: *channel,
        cycles,
    };
    Some((UnitName::new(wired.unit?), sensor))
}

impl Analog {
    fn new(context: &Context<'_>, classes: BTreeMap<(UnitName, Cycle), Vec<Sensor>>) -> Self {
        let mut drivers = BTreeSet::new();
        let mut groups = Vec::new();
        for ((unit, cycle), mut sensors) in classes {
            let Some(driver) = context.names.driver(unit.as_str()) else { continue };
            drivers.insert((unit.clone(), driver.clone()));
            sensors.sort_by_key(|sensor| sensor.channel);
            for (column, sensor) in sensors.iter_mut().enumerate() {
                sensor.column = column;
            }
            groups.push(Group::new(groups.len(), (unit, driver), cycle, sensors));
        }
        Self { drivers: drivers.into_iter().map(|(_, driver)| driver).collect(), groups }
    }
}

impl Group {
    fn new(
        index: usize,
        (unit, driver): (UnitName, String),
        cycle: Cycle,
        sensors: Vec<Sensor>,
    ) -> Self {
        let sample = |register: u8, sensor: &Sensor| {
            let Sensor { channel, cycles, .. } = sensor;
            format!("ADC_SMPR{register}_SMP_AN{channel}(ADC_SAMPLE_{cycles})")
        };
        let samples = |register: u8| {
            // Inputs from 10 on have their times in the first register.
            let own = sensors.iter().filter(|sensor| (sensor.channel >= 10) == (register == 1));
            sum(own.map(|sensor| sample(register, sensor)))
        };
        let sequence = |register: u8, places: std::ops::RangeInclusive<usize>| {
            let own = sensors.iter().filter(|sensor| places.contains(&(sensor.column + 1)));
            let own = own.map(|Sensor { column, channel, .. }| {
                format!("ADC_SQR{register}_SQ{}_N(ADC_CHANNEL_IN{channel})", column + 1)
            });
            own.collect::<Vec<_>>()
        };
        let count = format!("ADC_SQR1_NUM_CH({}U)", sensors.len());
        Self {
            index,
            unit,
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

    fn work(&self) -> Work {
        Work {
            unit: self.unit.to_string(),
            cycle: self.cycle,
            function: "up_adc_cycle",
            table: format!("adc_{}", self.index),
            device: self.sensors.first().map_or(0, |sensor| sensor.id),
            stack_bytes: STACK_BYTES,
        }
    }

    /// For a comment.
    fn title(&self) -> String {
        self.cycle.title(self.unit.as_str())
    }

    /// For a comment.
    fn names(&self) -> String {
        let names: Vec<&str> = self.sensors.iter().map(|sensor| sensor.name.as_str()).collect();
        names.join(", ")
    }
}

/// Macros or-ed together, a line each; `0U` when there is none.
fn sum(terms: impl Iterator<Item = String>) -> String {
    let terms: Vec<String> = terms.collect();
    if terms.is_empty() { "0U".to_owned() } else { terms.join(" |\n             ") }
}
