//! Values beyond the limits of their part's data sheet: a design in, reports out.

use sensedsl_board::silicon;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_diagnostics::codes::{
    e0232_address_of_part, e0233_clock_over_part, w0613_level_over_part, w0616_driven_over_part,
};

use crate::design::{Board, BoardIndex, Bounds, Connection, Design, Part, PartIndex};
use crate::kind::Interface;
use crate::value::written::{shown_hz, shown_mv};

/// Reports values that exceed the bounds of their part.
pub(crate) fn check(design: &Design, diagnostics: &mut Vec<Diagnostic>) {
    for wires in &design.connections {
        let Some(part) = design.part(wires.part) else { continue };
        let Some(driver) = &part.driver else { continue };
        diagnostics.extend(foreign_address(wires, driver, &part.bounds));
        diagnostics.extend(too_fast(wires, driver, &part.bounds));
        diagnostics.extend(too_high(wires, driver, &part.bounds));
    }
    for (number, part) in design.parts.iter().enumerate() {
        let Some(driver) = &part.driver else { continue };
        diagnostics.extend(driven_too_high(design, (PartIndex(number), part), driver));
    }
}

fn foreign_address(wires: &Connection, driver: &str, bounds: &Bounds) -> Option<Diagnostic> {
    let i2c = wires.kind.i2c()?;
    let (address, at) = (i2c.address, i2c.address_span?);
    let first = bounds.addresses.first()?;
    if bounds.addresses.contains(&address) {
        return None;
    }
    let is_eight_bit = address % 2 == 0 && bounds.addresses.contains(&(address >> 1));
    let help = if is_eight_bit {
        let meant = address >> 1;
        format!(
            "0x{address:02X} is the 8-bit form of 0x{meant:02X}: write `address = 0x{meant:02X};`"
        )
    } else if bounds.addresses.len() == 1 {
        format!("write `address = 0x{first:02X};`")
    } else {
        format!("write `address = 0x{first:02X};` or another of these")
    };
    let has = listed(&bounds.addresses);
    let meant = [address >> 1];
    let others = if is_eight_bit { meant.as_slice() } else { bounds.addresses.as_slice() };
    let report = e0232_address_of_part::address_of_part;
    Some(report(at, address, driver, (&has, &help), others))
}

/// Formats addresses for people: `0x68 or 0x69`, `0x40 to 0x4F`.
fn listed(addresses: &[u8]) -> String {
    let mut sorted = addresses.to_vec();
    sorted.sort_unstable();
    sorted.dedup();
    let mut runs: Vec<(u8, u8)> = Vec::new();
    for address in sorted {
        match runs.last_mut() {
            Some((_, last)) if last.checked_add(1) == Some(address) => *last = address,
            Some(_) | None => runs.push((address, address)),
        }
    }
    let words = runs.into_iter().flat_map(|(first, last)| match last - first {
        0 => vec![format!("0x{first:02X}")],
        1 => vec![format!("0x{first:02X}"), format!("0x{last:02X}")],
        _ => vec![format!("0x{first:02X} to 0x{last:02X}")],
    });
    let words: Vec<String> = words.collect();
    match words.as_slice() {
        [first @ .., last] if !first.is_empty() => format!("{} or {last}", first.join(", ")),
        all => all.concat(),
    }
}

fn too_fast(wires: &Connection, driver: &str, bounds: &Bounds) -> Option<Diagnostic> {
    let most = bounds.clock_max_hz?;
    let (property, asked, at) = match wires.kind.interface() {
        Interface::I2c(i2c) => ("speed", i2c.speed_hz, i2c.speed_span?),
        Interface::Spi(spi) => ("clock", spi.clock_hz, spi.clock_span?),
        Interface::Analog(_)
        | Interface::Can(_)
        | Interface::Code(_)
        | Interface::Dac(_)
        | Interface::Digital(_)
        | Interface::Encoder(_)
        | Interface::Icu(_)
        | Interface::OneWire(_)
        | Interface::Pwm(_)
        | Interface::Stepper(_)
        | Interface::Uart(_) => return None,
    };
    let (asked_words, most_words) = (shown_hz(asked), shown_hz(most));
    let over = e0233_clock_over_part::clock_over_part;
    (asked > most).then(|| over(at, property, &asked_words, driver, &most_words))
}

fn too_high(wires: &Connection, driver: &str, bounds: &Bounds) -> Option<Diagnostic> {
    let (_, most) = bounds.supply_mv?;
    let level = wires.level.filter(|level| level.mv > most)?;
    let (shown, most) = (shown_mv(level.mv), shown_mv(most));
    Some(w0613_level_over_part::level_over_part(level.span, &shown, driver, &most))
}

/// Reports wires that a board drives above the part's supply. A stated divider is between the part
/// and a pin that reads it, so it does not help here.
fn driven_too_high(
    design: &Design,
    (index, part): (PartIndex, &Part),
    driver: &str,
) -> Option<Diagnostic> {
    let (_, most) = part.bounds.supply_mv?;
    // A part that may go to any of several boards can go to the one that suits it.
    let boards: Vec<&Board> = match part.board {
        Some(BoardIndex(own)) => design.boards.get(own).into_iter().collect(),
        None => design.boards.iter().collect(),
    };
    let level = |board: &&Board| Some(silicon::volts(board.mcu.as_deref()?)?.supply_mv);
    let levels: Option<Vec<u32>> = boards.iter().map(level).collect();
    let level = levels?.into_iter().min().filter(|level| *level > most)?;
    let own = design.connections.iter().filter(|one| one.part == index);
    let driven = own.flat_map(|one| {
        let roles = one.kind.roles(one.direction).into_iter();
        roles.filter(|role| !role.is_driven_by_device()).map(|role| one.wire_name(role))
    });
    let driven: Vec<String> = driven.map(|wire| format!("`{wire}`")).collect();
    let (shown, bound) = (shown_mv(level), shown_mv(most));
    let (at, name, wires) = (part.name.span, part.name.value.as_str(), driven.join(", "));
    let over = w0616_driven_over_part::driven_over_part;
    (!driven.is_empty()).then(|| over(at, (name, &wires, &shown), (driver, &bound)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn addresses_are_listed_in_runs() {
        assert_eq!(listed(&[0x69, 0x68]), "0x68 or 0x69");
        assert_eq!(listed(&[0x40, 0x41, 0x42, 0x46]), "0x40 to 0x42 or 0x46");
        assert_eq!(listed(&[0x29]), "0x29");
    }
}
