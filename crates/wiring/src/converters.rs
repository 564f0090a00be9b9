//! The choice of the converter that samples each analog input.
//!
//! Devices of one class (cycle time and priority) share one conversion group, so they want one
//! unit: the lowest that serves all of them. If none does, the unit that serves most of those that
//! are left is taken, again and again. If there are not enough DMA streams for these units beside
//! the other peripherals, fewer units are tried.

use std::collections::{BTreeMap, BTreeSet};

use sensedsl_board::signal::Function;
use sensedsl_board::table::Usage;
use sensedsl_model::design::{
    Board, Connection, ConnectionIndex, Design, PartIndex, Preference, PreferenceSubject, Together,
};

use crate::assignment::ConnectionWiring;
use crate::builder::Converters;

/// An analog input and the converters that can sample it.
type Input = (ConnectionIndex, BTreeSet<u8>);

/// The converter of each analog input on the board, such that `streams_suffice` for the choice;
/// `None` if no choice will do. Wishes for converters are given up if the problem has already
/// counted them.
pub(crate) fn choose(
    design: &Design,
    board: &Board,
    wirings: &[ConnectionWiring],
    when: Converters,
    streams_suffice: impl Fn(&Choice) -> bool,
) -> Option<Choice> {
    let with = |wishes| best(&classes(design, board, wirings, wishes), &streams_suffice);
    with(true).or_else(|| if when == Converters::Now { with(false) } else { None })
}

fn best(classes: &Classes, streams_suffice: impl Fn(&Choice) -> bool) -> Option<Choice> {
    let inputs = || classes.values().flatten();
    let all: BTreeSet<u8> = inputs().flat_map(|(_, units)| units).copied().collect();
    // No MCU has more than five converters: try all subsets, the whole set first.
    subsets(&all).find_map(|allowed| {
        let serves = |(_, units): &Input| units.is_empty() || !units.is_disjoint(&allowed);
        let choice = inputs().all(serves).then(|| choice(classes, &allowed))?;
        streams_suffice(&choice).then_some(choice)
    })
}

/// The converter of each analog input.
pub(crate) type Choice = BTreeMap<ConnectionIndex, String>;

/// Analog devices by cycle time and priority.
type Classes = BTreeMap<(u32, i8), Vec<Input>>;

/// The classes; with `wishes`, only the converters that meet most wishes are left.
fn classes(design: &Design, board: &Board, wirings: &[ConnectionWiring], wishes: bool) -> Classes {
    let mut classes = Classes::new();
    for wiring in wirings {
        let Some(connection) = design.connection(wiring.connection) else { continue };
        let Some(device) = design.device(connection.device) else { continue };
        if !connection.kind.is_sampled() {
            continue;
        }
        let fixed = connection.placement.unit.as_ref().map(|unit| unit.value.as_str());
        let units = units(board, wiring, fixed);
        let class = (device.delay_ms, device.prio);
        classes.entry(class).or_default().push((wiring.connection, units));
    }
    for class in classes.values_mut() {
        keep_together(design, board, class);
        for (connection, units) in class.iter_mut().filter(|_| wishes) {
            let own = design.connection(*connection).map(|one| one.wishes.as_slice());
            *units = wished(board, std::mem::take(units), own.unwrap_or_default());
        }
    }
    classes
}

/// Leaves the elements of an array that are wanted on one converter only converters that serve all
/// of them.
fn keep_together(design: &Design, board: &Board, class: &mut [Input]) {
    let tied = |connection: &ConnectionIndex| -> Option<PartIndex> {
        let connection: &Connection = design.connection(*connection)?;
        let hard = connection.placement.together.iter().any(|one| one.value == Together::Unit);
        let mut wishes = connection.wishes.iter().chain(&board.wishes);
        let mut wished =
            || wishes.any(|wish| wish.what == PreferenceSubject::Together(Together::Unit));
        (connection.element.is_some() && (hard || wished())).then_some(connection.part)
    };
    let mut common: BTreeMap<PartIndex, BTreeSet<u8>> = BTreeMap::new();
    for (connection, units) in class.iter() {
        let Some(part) = tied(connection) else { continue };
        let all = common.entry(part).or_insert_with(|| units.clone());
        *all = &*all & units;
    }
    for (connection, units) in class {
        let common = tied(connection).and_then(|part| common.get(&part));
        // A wish that cannot be kept leaves none.
        if let Some(common) = common.filter(|common| !common.is_empty()) {
            units.clone_from(common);
        }
    }
}

/// For each class, as few of the allowed units as will do.
fn choice(classes: &Classes, allowed: &BTreeSet<u8>) -> Choice {
    let mut chosen = Choice::new();
    for class in classes.values() {
        let restricted = |(device, units): &Input| (*device, units & allowed);
        let mut left: Vec<Input> = class.iter().map(restricted).collect();
        while let Some(unit) = best_unit(&left) {
            let (served, rest): (Vec<_>, Vec<_>) =
                left.into_iter().partition(|(_, units)| units.contains(&unit));
            chosen.extend(served.into_iter().map(|(device, _)| (device, format!("ADC{unit}"))));
            left = rest;
        }
    }
    chosen
}

/// The set, then its subsets from the larger to the smaller, in the order of what they keep.
fn subsets(all: &BTreeSet<u8>) -> impl Iterator<Item = BTreeSet<u8>> {
    let members: Vec<u8> = all.iter().copied().collect();
    let mut masks: Vec<u32> = (0..1_u32 << members.len().min(SUBSET_MAX)).collect();
    masks.sort_by_key(|mask| (std::cmp::Reverse(mask.count_ones()), *mask));
    masks.into_iter().map(move |mask| {
        let kept = members.iter().enumerate().filter(|(at, _)| mask >> at & 1 == 1);
        kept.map(|(_, unit)| *unit).collect()
    })
}

/// More converters than any MCU has.
const SUBSET_MAX: usize = 10;

/// The converters that can sample an input.
fn units(board: &Board, wiring: &ConnectionWiring, fixed: Option<&str>) -> BTreeSet<u8> {
    let usage = wiring.wires.first().and_then(|wire| wire.usage(board));
    usage.map(|usage| sampling(board, usage, fixed)).unwrap_or_default()
}

/// The converters that can sample the signal of a usage.
fn sampling(board: &Board, usage: &Usage, fixed: Option<&str>) -> BTreeSet<u8> {
    let Function::Adc { units, channel } = usage.signal.function() else {
        return BTreeSet::new();
    };
    let serves = |unit: &u8| {
        let name = format!("ADC{unit}");
        fixed.is_none_or(|fixed| board.same_unit(fixed, &name))
            && board.reserved.iter().all(|reserved| !board.same_unit(&reserved.value, &name))
            && board.profile().is_none_or(|profile| {
                profile.adc(*unit).is_some_and(|adc| adc.inputs.contains(channel))
            })
    };
    units.iter().copied().filter(serves).collect()
}

/// The peripheral instances that can serve a usage.
pub(crate) fn units_of(board: &Board, usage: &Usage, fixed: Option<&str>) -> Vec<String> {
    if matches!(usage.signal.function(), Function::Adc { .. }) {
        return sampling(board, usage, fixed).iter().map(|unit| format!("ADC{unit}")).collect();
    }
    usage.signal.function().units().iter().map(ToString::to_string).collect()
}

/// The units that meet most of the wishes for units.
fn wished(board: &Board, units: BTreeSet<u8>, own: &[Preference]) -> BTreeSet<u8> {
    let met = |unit: u8| {
        let wishes = own.iter().chain(&board.wishes).filter_map(|wish| match &wish.what {
            PreferenceSubject::Unit(wanted) => {
                Some(board.same_unit(wanted, &format!("ADC{unit}")) == wish.prefer)
            }
            PreferenceSubject::Pin(..)
            | PreferenceSubject::Side(_)
            | PreferenceSubject::Header(_)
            | PreferenceSubject::Together(_)
            | PreferenceSubject::Sequence => None,
        });
        wishes.filter(|met| *met).count()
    };
    let most = units.iter().map(|unit| met(*unit)).max().unwrap_or_default();
    units.into_iter().filter(|unit| met(*unit) == most).collect()
}

/// The unit that serves most of the devices; of several, the lowest.
fn best_unit(devices: &[Input]) -> Option<u8> {
    let all: BTreeSet<u8> = devices.iter().flat_map(|(_, units)| units).copied().collect();
    let served = |unit: u8| devices.iter().filter(|(_, units)| units.contains(&unit)).count();
    all.into_iter().rev().max_by_key(|unit| served(*unit))
}
