//! Which converter samples which analog input.
//!
//! Devices of one class (cycle time and priority) share one conversion group, so they want one
//! unit: the lowest that serves all of them; where none does, the unit that serves most of those
//! that are left, again and again.

use std::collections::{BTreeMap, BTreeSet};

use sensedsl_board::signal::Function;
use sensedsl_model::design::{Board, Design, DeviceIndex, Wish, WishFor};
use sensedsl_model::kind::Kind;

use crate::assignment::DeviceWiring;

/// An analog device and the converters that can sample it.
type Input = (DeviceIndex, BTreeSet<u8>);

/// The converter of each analog device on the board.
pub(crate) fn choose(
    design: &Design,
    board: &Board,
    wirings: &[DeviceWiring],
) -> BTreeMap<DeviceIndex, String> {
    let mut classes: BTreeMap<(u32, i8), Vec<Input>> = BTreeMap::new();
    for wiring in wirings {
        let Some(device) = design.device(wiring.device) else { continue };
        if !matches!(device.kind, Kind::Analog(_)) {
            continue;
        }
        let fixed = device.placement.unit.as_ref().map(|unit| unit.value.as_str());
        let units = wished(units(board, wiring, fixed), &device.wishes, &board.wishes);
        let class = (device.delay_ms, device.prio);
        classes.entry(class).or_default().push((wiring.device, units));
    }
    let mut chosen = BTreeMap::new();
    for mut left in classes.into_values() {
        while let Some(unit) = best_unit(&left) {
            let (served, rest): (Vec<_>, Vec<_>) =
                left.into_iter().partition(|(_, units)| units.contains(&unit));
            chosen.extend(served.into_iter().map(|(device, _)| (device, format!("ADC{unit}"))));
            left = rest;
        }
    }
    chosen
}

/// The units that can sample a device's input.
fn units(board: &Board, wiring: &DeviceWiring, fixed: Option<&str>) -> BTreeSet<u8> {
    let usage = wiring.wires.first().and_then(|wire| wire.usage(board));
    let Some(Function::Adc { units, channel }) = usage.map(|usage| usage.signal.function()) else {
        return BTreeSet::new();
    };
    let serves = |unit: &u8| {
        let name = format!("ADC{unit}");
        fixed.is_none_or(|fixed| fixed == name)
            && board.reserved.iter().all(|reserved| reserved.value != name)
            && board.profile().is_none_or(|profile| {
                profile.adc(*unit).is_some_and(|adc| adc.inputs.contains(channel))
            })
    };
    units.iter().copied().filter(serves).collect()
}

/// The units that meet most of the wishes for units.
fn wished(units: BTreeSet<u8>, own: &[Wish], of_board: &[Wish]) -> BTreeSet<u8> {
    let met = |unit: u8| {
        let wishes = own.iter().chain(of_board).filter_map(|wish| match &wish.what {
            WishFor::Unit(wanted) => Some((*wanted == format!("ADC{unit}")) == wish.prefer),
            WishFor::Pin(..) | WishFor::Side(_) | WishFor::Header(_) => None,
        });
        wishes.filter(|met| *met).count()
    };
    let most = units.iter().map(|unit| met(*unit)).max().unwrap_or_default();
    units.into_iter().filter(|unit| met(*unit) == most).collect()
}

/// The unit that serves most of the devices, the lowest of those.
fn best_unit(devices: &[Input]) -> Option<u8> {
    let all: BTreeSet<u8> = devices.iter().flat_map(|(_, units)| units).copied().collect();
    let served = |unit: u8| devices.iter().filter(|(_, units)| units.contains(&unit)).count();
    all.into_iter().rev().max_by_key(|unit| served(*unit))
}
