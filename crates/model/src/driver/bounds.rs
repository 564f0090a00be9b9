//! Limits from a part's data sheet: a driver in, its [`Bounds`] out, with reports of what is not a limit.

use sensedsl_diagnostics::Diagnostic;
use sensedsl_syntax::ast::AstNode as _;

use super::Driver;
use super::known::Known;
use crate::design::Bounds;
use crate::fields::{Fields, plain_integer};
use crate::spanned::span;
use crate::value::{Dimension, Measure, Value};

/// The greatest clock that a driver can state, which is more than any part of the library takes.
const CLOCK_MAX_HZ: u32 = 100_000_000;
/// Addresses from here on are in the 8-bit form.
const EIGHT_BIT: u8 = 0x80;

/// The bounds of the part that a driver is for.
pub(crate) fn of(driver: Option<&Driver>, known: Known<'_>) -> Bounds {
    let Some(driver) = driver else { return Bounds::default() };
    // Mistakes in them are reported once for the driver, not for each device.
    let mut reported = Vec::new();
    of_driver(driver, known, &mut reported)
}

/// Like [`of`], but also reports mistakes.
pub(crate) fn of_driver(
    driver: &Driver,
    known: Known<'_>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Bounds {
    let at = span(driver.file, driver.node.range());
    let own = driver
        .node
        .properties()
        .filter(|one| one.name().is_some_and(|name| BOUNDS.contains(&name.text())));
    let reported = (known.constants, diagnostics);
    read(&mut Fields::new(own, driver.file, "a driver", at, reported))
}

/// Takes the properties that give a part's bounds.
pub(crate) fn read(fields: &mut Fields<'_>) -> Bounds {
    let speed = fields.frequency_hz("speed_max", 1_000..=CLOCK_MAX_HZ);
    let clock = fields.frequency_hz("clock_max", 1_000..=CLOCK_MAX_HZ);
    Bounds {
        addresses: addresses(fields),
        clock_max_hz: speed.or(clock).map(|clock| clock.value),
        supply_mv: supply(fields),
    }
}

/// The properties that give a part's bounds.
const BOUNDS: [&str; 4] = ["addresses", "speed_max", "clock_max", "supply"];

/// A voltage, or a range of them.
fn supply(fields: &mut Fields<'_>) -> Option<(u32, u32)> {
    let mv = |value: &Value| {
        let number = value.number()?;
        let is_volts = number.measure == Measure::Bare || number.dimension() == Dimension::VOLTAGE;
        let mv = (number.in_base_units() * 1e3).round();
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "compared with a range just before"
        )]
        (is_volts && (0.0..=1e9).contains(&mv)).then_some(mv as u32)
    };
    let ends = |value: &Value| match value.range() {
        Some([first, last]) => mv(&first.value).zip(mv(&last.value)),
        None => mv(value).map(|one| (one, one)),
    };
    let takes = "a voltage such as 5 V, or a range such as 2.4 V..3.6 V";
    fields.read("supply", takes, ends).map(|ends| ends.value)
}

fn addresses(fields: &mut Fields<'_>) -> Vec<u8> {
    let one = |value: &Value| {
        let byte = u8::try_from(plain_integer(value)?).ok()?;
        Some(if byte >= EIGHT_BIT { byte >> 1 } else { byte })
    };
    fields.list("addresses", "a list of addresses such as [0x68, 0x69]", one)
}
