//! Parts that share a serial line, and parts that the board speaks with: reports of what is impossible.
//!
//! In: a design. Out: diagnostics for two parts with one address, and for a part that is asked for one value and sends
//! another by itself.

use sensedsl_diagnostics::Diagnostic;
use sensedsl_diagnostics::codes::{e0243_one_address, e0244_asked_and_listened};
use sensedsl_wire::Direction;

use crate::design::{Connection, Design, Device};

/// Reports what is impossible.
pub(crate) fn check(design: &Design, diagnostics: &mut Vec<Diagnostic>) {
    let mut before: Vec<&Connection> = Vec::new();
    for one in &design.connections {
        let twin = before.iter().find(|other| clash(one, other));
        if let Some(other) = twin {
            diagnostics.extend(one_address(design, one, other));
        }
        before.push(one);
    }
    for device in &design.devices {
        diagnostics.extend(speaks(design, device));
    }
}

/// Whether two connections would be on one line with one address.
fn clash(one: &Connection, other: &Connection) -> bool {
    let (Some(own), Some(its)) = (one.kind.uart(), other.kind.uart()) else { return false };
    let unit = |of: &Connection| of.placement.unit.as_ref().map(|unit| unit.value.clone());
    let are_apart = matches!((unit(one), unit(other)), (Some(a), Some(b)) if a != b);
    let same_address =
        own.exchange.address.is_some() && own.exchange.address == its.exchange.address;
    same_address && own.line() == its.line() && one.board == other.board && !are_apart
}

fn one_address(design: &Design, one: &Connection, other: &Connection) -> Option<Diagnostic> {
    let exchange = &one.kind.uart()?.exchange;
    let (name, its) = (&design.part(one.part)?.name, &design.part(other.part)?.name);
    let at = name.span;
    let report = e0243_one_address::one_address;
    Some(report(at, &name.value, exchange.address?, &its.value, its.span))
}

/// Reports a value that comes by itself from a part that the board speaks with.
fn speaks(design: &Design, device: &Device) -> Option<Diagnostic> {
    let own = device.kind.uart()?;
    if device.direction != Direction::Sensor || !own.exchange.request.is_empty() {
        return None;
    }
    let of_part = design.devices.iter().filter(|one| one.part == device.part);
    let asked = of_part.filter_map(|one| Some((one, &one.kind.uart()?.exchange)));
    let mut spoken_with = asked.filter(|(_, exchange)| exchange.is_dialogue());
    let (other, _) = spoken_with.next()?;
    let why = if std::ptr::eq(other, device) { "its line is shared" } else { "is asked or told" };
    let report = e0244_asked_and_listened::asked_and_listened;
    Some(report(device.name.span, &device.name.value, why, other.name.span))
}
