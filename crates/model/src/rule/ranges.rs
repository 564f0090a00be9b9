//! Values that are never reached and numbers that cannot be held: a design in, reports out.

use std::collections::BTreeMap;

use sensedsl_board::silicon;
use sensedsl_diagnostics::codes::{
    e0235_analog_over_supply, e0236_bound_out_of_reach, w0611_narrow_command, w0612_shown_not_raw,
};
use sensedsl_diagnostics::{Diagnostic, FileId};
use sensedsl_wire::{Direction, ScalarType};

use super::checks::like;
use crate::design::{Bare, Board, Design, Device};
use crate::part::reach::{of_part, of_type, raw, shown};
use crate::value::written::{divider, rounded, shown_mv, shown_ohm};

/// The greatest supply of an unknown MCU, in millivolts.
const SUPPLY_MAX_MV: u32 = 5_000;

/// Reports types that cannot hold an actuator's range, and bounds that are never reached.
pub(crate) fn check(design: &Design, diagnostics: &mut Vec<Diagnostic>) {
    for device in &design.devices {
        diagnostics.extend(narrow(device));
        let over = over_supply(design, device).or_else(|| beyond(device));
        // A bound in a driver of the file was reported at the driver.
        let is_told = |one: &Diagnostic| {
            diagnostics
                .iter()
                .any(|told| told.code == one.code && told.primary.span == one.primary.span)
        };
        if let Some(over) = over.filter(|over| !is_told(over)) {
            diagnostics.push(over);
        }
    }
    diagnostics.extend(bare_numbers(design));
}

/// Warns once per file of bare numbers that used to be codes.
fn bare_numbers(design: &Design) -> Vec<Diagnostic> {
    let mut of_files: BTreeMap<FileId, Vec<(&Device, &Bare)>> = BTreeMap::new();
    for device in &design.devices {
        let Some(bare) = &device.shown.bare else { continue };
        of_files.entry(bare.span.file).or_default().push((device, bare));
    }
    let reported = of_files.into_values().filter_map(|mut all| {
        all.sort_by_key(|(_, bare)| bare.span);
        let (device, bare) = all.first()?;
        let unit = device.shown.quantity.as_deref().map(|unit| format!(" {unit}"));
        let shown = format!("{}{}", bare.number, unit.unwrap_or_default());
        let write = match &bare.with_unit {
            Some(text) => format!("write `{text}` if that is meant"),
            None => "write `allow W0612 \"the shown value is meant\";` if it is".to_owned(),
        };
        let code = bare.code.to_string();
        let more = all.len() - 1;
        let raw = format!("raw {}", bare.number);
        let ways = [bare.with_unit.as_deref(), Some(raw.as_str())];
        let report = w0612_shown_not_raw::shown_not_raw;
        Some(report(bare.span, (&shown, &code), more, &write, ways))
    });
    reported.collect()
}

fn narrow(device: &Device) -> Option<Diagnostic> {
    if device.direction == Direction::Sensor {
        return None;
    }
    let value = device.value.value;
    let held = of_type(value.scalar)?;
    let takes = of_part(&device.kind, &device.coding, value)?;
    if (held.0 <= takes.0 && held.1 >= takes.1) || value.scalar == ScalarType::Bool {
        return None;
    }
    let of = device.coding.of.filter(|of| of_type(of.scalar).is_none_or(|of| of.1 >= takes.1));
    let wider = match of.filter(|of| of.scalar != value.scalar) {
        Some(of) => of.scalar.name(),
        None if takes.0 < 0.0 => "int16",
        None => "uint16",
    };
    let (found, name) = (value.scalar.name(), &device.name.value);
    let words = |(least, most): (f64, f64)| format!("{least} to {most}");
    let narrow = w0611_narrow_command::narrow_command;
    let (found, device_takes) = ((found, &*words(held)), (name.as_str(), &*words(takes)));
    Some(narrow(device.value.span, found, device_takes, (wider, &like(value, wider))))
}

/// Reports an analog input's voltage that exceeds the supply, with no divider.
fn over_supply(design: &Design, device: &Device) -> Option<Diagnostic> {
    let (max, at) = (device.shown.max?, *device.shown.bounds.last()?);
    let wires = design.main_connection(device).filter(|_| device.kind.is_sampled())?;
    let factor = match device.shown.quantity.as_deref() {
        Some("V") => 1e3,
        Some("mV") => 1.0,
        Some(_) | None => return None,
    };
    if wires.level.is_some_and(|level| level.divider.is_some()) {
        return None;
    }
    let boards =
        design.boards.iter().zip(0..).filter(|(_, at)| wires.board.is_none_or(|own| own.0 == *at));
    let supply_mv = boards.map(|(board, _)| supply_mv(board)).max()?;
    // A user's own scale implies a divider, for the voltages that the scale covers.
    let is_scaled = device.shown.scale.is_some() || !device.shown.curve.is_empty();
    let is_reached = is_scaled && shown(device).is_some_and(|(_, most)| most >= max);
    if max * factor <= f64::from(supply_mv) || is_reached {
        return None;
    }
    let (level, supply) = (format!("{} V", max * factor / 1e3), shown_mv(supply_mv));
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates")]
    let [upper, lower] = divider((max * factor).ceil() as u32, supply_mv).map(shown_ohm);
    let help = format!(
        "divide it by two resistors, and say so: `level = {level}; divider = [{upper}, {lower}]; scale = {} / 4095;`",
        f64::from(supply_mv) / 1e3
    );
    let over = e0235_analog_over_supply::analog_over_supply;
    Some(over(at?, &device.name.value, &level, &supply, &help))
}

fn supply_mv(board: &Board) -> u32 {
    let volts = board.mcu.as_deref().and_then(silicon::volts);
    volts.map_or(SUPPLY_MAX_MV, |volts| volts.supply_mv)
}

/// Warns of a bound that the shown value never reaches.
pub(crate) fn beyond(device: &Device) -> Option<Diagnostic> {
    let (least, most) = shown(device)?;
    // One step short is not a mistake: 100 / 4096 ends one step below 100.
    let (first, last) = raw(device)?;
    let step = (most - least) / (last - first).max(1.0);
    let bounds = [("min", device.shown.min), ("max", device.shown.max)];
    for ((property, bound), at) in bounds.into_iter().zip(device.shown.bounds) {
        // There is a separate warning for a type narrower than the driver's bounds.
        let own = at.filter(|at| at.file == device.name.span.file);
        let (Some(bound), Some(at)) = (bound, own) else { continue };
        if bound >= least - step * 1.001 && bound <= most + step * 1.001 {
            continue;
        }
        let unit = device.shown.quantity.as_deref().map(|unit| format!(" {unit}"));
        let unit = unit.unwrap_or_default();
        let range = format!("{}{unit} to {}{unit}", rounded(least), rounded(most));
        let is_raw = device.shown.scale.is_none() && device.shown.curve.is_empty();
        let help = if is_raw {
            "give `scale` where the value is shown in another unit, take a wider type, or change the bound"
        } else {
            "write the bound in the unit that is shown, or correct `scale` and `offset`"
        };
        let (name, bound) = (&device.name.value, format!("{bound}{unit}"));
        let beyond = e0236_bound_out_of_reach::bound_out_of_reach;
        return Some(beyond(at, (property, &bound), name, &range, help));
    }
    None
}
