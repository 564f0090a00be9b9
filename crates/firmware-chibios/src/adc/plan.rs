//! The conversion groups and their threads, for all versions of the driver.
//!
//! The sensors of one unit, cycle and priority are a conversion group. A thread serves one group, or groups of several
//! units that have elements of the same array, which it starts together.

use std::collections::{BTreeMap, BTreeSet};

use askama::Template;
use sensedsl_board::profile::Cycles;
use sensedsl_board::signal::{Function, UnitName};
use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::kind::{Kind, KindName, Role};
use sensedsl_timing::sampling;

use super::group::{Group, Input};
use crate::context::Context;
use crate::names::Setting;
use crate::section::{Section, Size, Work};
use crate::stacks::Depth;
use sensedsl_files::block;
use sensedsl_job::part::FormulaPlan;
use sensedsl_job::{Cycle, JobConnection};

/// The stack depth of its thread.
const DEPTH: Depth = Depth { plain: [440, 320], filtered: [472, 344] };

/// The slowest possible converter, for the time-out of converters whose clock is not known.
const SLOWEST_HZ: u64 = 4_000_000;
/// The extra time for a group: the tick, and threads that are served first.
const PATIENCE_MS: u64 = 2;

/// All analog sensors.
#[derive(Template)]
#[template(path = "adc/tables.c.txt", escape = "none")]
struct Tables<'a> {
    tasks: &'a [Task],
    /// The sample value at the reference voltage.
    full: u32,
}

/// The conversions of one thread.
struct Task {
    ident: String,
    title: String,
    cycle: Cycle,
    /// The identifier of its first device.
    device: u8,
    /// Each group, with its C code.
    groups: Vec<(String, Group)>,
    /// The inputs in the order of fields and elements.
    inputs: Vec<Column>,
    /// The formulas, each with the device's identifier in code.
    formulas: Vec<(String, FormulaPlan)>,
    /// The number of 64-bit words that hold the largest value.
    value_words: usize,
}

/// The source of one element of a value.
struct Column {
    place: String,
    field: String,
    ident: String,
    element: u16,
    samples: u16,
    group: usize,
    column: usize,
    /// True if a formula computes the value.
    has_formula: bool,
}

/// Prints the C code of a conversion group for a version of the driver.
pub(super) type GroupText = fn(&Group) -> String;

/// The greatest sample value of most converters.
const TWELVE_BITS: u32 = 4_095;

/// The section, for a version whose samples go from 0 to `full`.
pub(super) fn plan(
    context: &Context<'_>,
    diagnostics: &mut Vec<Diagnostic>,
    text: GroupText,
    full: u32,
) -> Section {
    let mut section = Section::default();
    let mut classes: BTreeMap<(Cycle, UnitName), Vec<Input>> = BTreeMap::new();
    for wired in context.connections(KindName::Analog) {
        let Some((unit, input)) = input(context, wired) else { continue };
        let pad = wired.pad(Role::In);
        let pad = pad.and_then(|pad| context.pad(pad, "PAL_MODE_INPUT_ANALOG", diagnostics));
        section.pads.extend(pad);
        section.units.insert(unit.clone());
        classes.entry((wired.cycle, unit)).or_default().push(input);
    }
    let has_any = !classes.is_empty();
    let truth = if has_any { "TRUE" } else { "FALSE" };
    section.switch = Some(Setting::new("HAL_USE_ADC", truth));
    if !has_any {
        return section;
    }
    section.hal = ["ADC_USE_WAIT", "ADC_USE_MUTUAL_EXCLUSION"]
        .map(|name| Setting::new(name, "TRUE"))
        .to_vec();
    section.hal.push(Setting::new("ADC_DRIVER_EXT_FIELDS", "uint32_t up_errors;"));
    section.clocks.extend(context.profile.adc.clock.clone());
    // The converters' clock is set, so that it is the one their times were computed with.
    section.mcu = context.names.converters(section.units.iter());
    let groups = classes.into_iter().filter_map(|(class, inputs)| group(context, class, inputs));
    let tasks = tasks(context, groups.collect(), text);
    section.work = tasks.iter().map(Task::work).collect();
    let groups = tasks.iter().flat_map(|task| &task.groups);
    let drivers: BTreeSet<_> = groups.map(|(_, group)| (&group.unit, &group.driver)).collect();
    let start = |(_, driver): &(&UnitName, &String)| format!("(void)adcStart(&{driver}, NULL);");
    section.starts = drivers.iter().map(start).collect();
    section.sizes = vec![Size {
        comment: "Converters with more than 12 bits.",
        setting: Setting::new("UP_ADC_WIDE", if full > TWELVE_BITS { "TRUE" } else { "FALSE" }),
    }];
    section.tables = block(&Tables { tasks: &tasks, full });
    section
}

fn input(context: &Context<'_>, wired: &JobConnection<'_>) -> Option<(UnitName, Input)> {
    let Kind::Analog(analog) = &wired.connection.kind else { return None };
    let Function::Adc { channel, .. } = wired.pad(Role::In)?.usage?.signal.function() else {
        return None;
    };
    let input = Input {
        place: wired.place(),
        fields: wired.devices.clone(),
        element: wired.element(),
        samples: analog.samples,
        channel: *channel,
        cycles: sampling(&context.profile.adc, analog.sampling_cycles)?,
    };
    Some((UnitName::new(wired.unit?), input))
}

fn group(
    context: &Context<'_>,
    (cycle, unit): (Cycle, UnitName),
    mut inputs: Vec<Input>,
) -> Option<Group> {
    let driver = context.names.driver(unit.as_str())?;
    inputs.sort_by_key(|input| input.channel);
    let mut wired = context.connections(KindName::Analog);
    let streams = wired.find(|one| one.unit == Some(unit.as_str())).map(|one| &one.streams);
    let buffer = context.names.buffer(streams.map_or(&[], |streams| streams.as_slice()));
    let mut group = Group { unit, driver, cycle, buffer, inputs, timeout_ms: 0 };
    group.timeout_ms = timeout_ms(context, &group);
    Some(group)
}

/// The time-out of a group: twice its conversion time, and some more.
fn timeout_ms(context: &Context<'_>, group: &Group) -> u64 {
    let facts = &context.profile.adc;
    let clocks = &context.chibios.clocks_hz;
    let hz = facts.clock.as_ref().and_then(|name| clocks.get(name.as_str()));
    let hz = hz.map_or(SLOWEST_HZ, |hz| u64::from(*hz) / u64::from(facts.clock_divider.max(1)));
    let conversion = facts.conversion_cycles.map_or(40, Cycles::halves);
    let halves = group.inputs.iter().map(|input| u64::from(input.cycles.halves() + conversion));
    let halves = halves.sum::<u64>() * u64::from(group.depth());
    (halves * 1_000).div_ceil(hz.max(1)) + PATIENCE_MS
}

/// The groups of each thread: those of one cycle that share a field are served together.
fn tasks(context: &Context<'_>, groups: Vec<Group>, text: GroupText) -> Vec<Task> {
    let mut together: Vec<Vec<Group>> = Vec::new();
    for group in groups {
        let shares = |other: &Group| {
            other.cycle == group.cycle
                && group.fields().any(|field| other.fields().any(|one| one == field))
        };
        let (mut own, others): (Vec<_>, Vec<_>) =
            together.into_iter().partition(|task| task.iter().any(shares));
        together = others;
        let mut all: Vec<Group> = own.drain(..).flatten().collect();
        all.push(group);
        together.push(all);
    }
    let mut tasks: Vec<Task> =
        together.into_iter().filter_map(|groups| Task::new(context, groups, text)).collect();
    tasks.sort_by(|a, b| a.order().cmp(&b.order()));
    tasks
}

impl Group {
    /// The devices with elements in this group.
    fn fields(&self) -> impl Iterator<Item = usize> {
        self.inputs.iter().flat_map(|input| input.fields.iter().copied())
    }
}

impl Task {
    fn new(context: &Context<'_>, mut groups: Vec<Group>, text: GroupText) -> Option<Self> {
        // All threads take units in the same order, so that no two of them wait for each other.
        groups.sort_by(|a, b| a.unit.cmp(&b.unit));
        let first = groups.first()?;
        let (ident, cycle) = (first.ident(), first.cycle);
        let units: Vec<&str> = groups.iter().map(|group| group.unit.as_str()).collect();
        let title = cycle.title(&units.join(" and "));
        let columns = groups.iter().enumerate().flat_map(|(at, group)| {
            group.inputs.iter().enumerate().map(move |(column, input)| (at, column, input))
        });
        let mut inputs = Vec::new();
        for (at, column, input) in columns {
            inputs.extend(input.fields.iter().map(|field| (*field, at, column, input)));
        }
        inputs.sort_by_key(|(field, _, _, input)| (*field, input.element));
        let device = inputs.first().and_then(|(field, ..)| context.job.devices.get(*field));
        let device = device.map_or(0, |one| one.device.id.value);
        let own: BTreeSet<usize> = inputs.iter().map(|(field, ..)| *field).collect();
        let own = own.iter().filter_map(|field| context.job.devices.get(*field));
        let words = |bytes: usize| bytes.div_ceil(8);
        let value_words = own.clone().map(|one| words(one.device.value.value.size_bytes())).max();
        let plans: Vec<&FormulaPlan> =
            context.job.parts.iter().flat_map(|part| &part.plan.formulas).collect();
        let formulas: Vec<(String, FormulaPlan)> = own
            .filter_map(|one| {
                let plan = plans.iter().find(|plan| plan.field == one.name())?;
                Some((one.ident.clone(), (*plan).clone()))
            })
            .collect();
        let inputs = inputs.into_iter().filter_map(|(field, group, column, input)| {
            let device = context.job.devices.get(field)?;
            let (field, ident) = (device.name().to_owned(), device.ident.clone());
            let has_formula = formulas.iter().any(|(own, _)| *own == ident);
            let Input { place, element, samples, .. } = input;
            let (place, element, samples) = (place.clone(), *element, *samples);
            Some(Column { place, field, ident, element, samples, group, column, has_formula })
        });
        let inputs = inputs.collect();
        let groups = groups.into_iter().map(|group| (text(&group), group)).collect();
        let value_words = value_words.unwrap_or(1);
        Some(Self { ident, title, cycle, device, groups, inputs, formulas, value_words })
    }

    /// The sorting key: by unit, then by cycle.
    fn order(&self) -> (Option<&UnitName>, Cycle) {
        (self.groups.first().map(|(_, group)| &group.unit), self.cycle)
    }

    fn work(&self) -> Work {
        let units = self.groups.iter().map(|(_, group)| group.unit.as_str());
        Work {
            unit: units.collect::<Vec<_>>().join("+"),
            cycle: self.cycle,
            function: "up_adc_cycle",
            table: self.ident.clone(),
            device: self.device,
            depth: DEPTH,
        }
    }
}
