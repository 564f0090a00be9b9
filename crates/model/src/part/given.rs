//! Values that a person gives for a device outside a `.sense` file, in a world or on a command
//! line: a text and a device in, the value as the device shows it, or its code, out. The rules are
//! those of the language.

use crate::design::{Device, Presentation};
use crate::fields::{Codes, ValueMismatch, in_quantity, of_pulse, unit_of};
use crate::kind::Interface;
use crate::part::reach;
use crate::value::{Measure, Number};

/// A value that was given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum EnteredValue {
    /// The value as the device shows it.
    Shown(f64),
    /// The code that goes over the wire.
    Code(f64),
}

/// Why a text is not a value that the device can have.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum EntryError {
    /// It is not a number, with or without a unit.
    NoNumber,
    /// It does not fit: what is wrong, and what to write.
    ValueMismatch(String, String),
}

/// A number as written: `1500 us`, `raw 307`.
struct Written<'t> {
    number: f64,
    unit: &'t str,
    is_raw: bool,
}

/// A value: `20`, `1500 us`, `-20 %`, `raw 307`.
///
/// # Errors
///
/// The text is not a number, or its unit is not one that the device shows.
pub fn value(text: &str, device: &Device) -> Result<EnteredValue, EntryError> {
    let written = written(text)?;
    if written.is_raw {
        return Ok(EnteredValue::Code(written.number));
    }
    let shown = &device.shown;
    if let Interface::Pwm(pwm) = device.kind.interface()
        && shown.quantity.is_none()
        && shown.is_plain()
        && !written.unit.is_empty()
    {
        let period_us = 1_000_000 / pwm.frequency_hz.max(1);
        let ends = [pwm.min_us.unwrap_or(0), pwm.max_us.unwrap_or(period_us)].map(f64::from);
        let codes = Codes {
            range: reach::fixed(&device.kind, &device.coding),
            is_whole: device.value.value.scalar.integer_range().is_some(),
            pulses_us: Some(ends.into()),
        };
        return Ok(EnteredValue::Code(
            of_pulse(&with_unit(&written, shown)?, codes).map_err(misfit)?,
        ));
    }
    in_unit(&written, shown).map(EnteredValue::Shown)
}

/// The difference of a value from another one: `0.5`, `5 deg`, `raw 20`.
///
/// # Errors
///
/// The errors of [`value`], and codes for a device with a curve, where a difference depends on the
/// place.
pub fn difference(text: &str, device: &Device) -> Result<f64, EntryError> {
    let written = written(text)?;
    let shown = &device.shown;
    if !written.is_raw {
        return in_unit(&written, shown);
    }
    if shown.curve.is_empty() {
        return Ok(written.number * shown.scale.unwrap_or(1.0));
    }
    let message = "along a `curve` a number of codes is not always as much".to_owned();
    Err(EntryError::ValueMismatch(message, "write it in the unit that is shown".to_owned()))
}

/// The growth of a value per second: `25`, `90 deg/s`.
///
/// # Errors
///
/// The errors of [`difference`].
pub fn a_second(text: &str, device: &Device) -> Result<f64, EntryError> {
    let written = written(text)?;
    if written.is_raw || written.unit.is_empty() {
        return difference(text, device);
    }
    // The unit of the growing quantity, per second.
    let quantity = device.shown.quantity.as_deref();
    let each = match quantity.map(|quantity| {
        unit_of(quantity).map_or_else(|| quantity.to_owned(), |unit| unit.name().to_owned())
    }) {
        Some(name) => match name.strip_suffix("/s") {
            Some(name) => format!("{name}/s^2"),
            None => format!("{name}/s"),
        },
        None => String::new(),
    };
    let shown = Presentation { quantity: quantity.map(|_| each), ..Presentation::default() };
    in_unit(&written, &shown)
}

/// A number in the unit that the device shows.
fn in_unit(written: &Written<'_>, shown: &Presentation) -> Result<f64, EntryError> {
    // A quantity may be a unit that the language does not have: `lx`.
    if written.unit.is_empty() || shown.quantity.as_deref() == Some(written.unit) {
        return Ok(written.number);
    }
    in_quantity(&with_unit(written, shown)?, shown).map_err(misfit)
}

fn with_unit(written: &Written<'_>, shown: &Presentation) -> Result<Number, EntryError> {
    let Some(unit) = unit_of(written.unit) else {
        let found = written.unit;
        let what = match &shown.quantity {
            Some(quantity) => format!("the device shows {quantity}, and `{found}` is not that"),
            None => format!("the value has no unit, and `{found}` is none"),
        };
        let help = match &shown.quantity {
            Some(quantity) => format!("write it in {quantity}, or as a code: `raw 307`"),
            None => "write the number alone".to_owned(),
        };
        return Err(EntryError::ValueMismatch(what, help));
    };
    Ok(Number { value: written.number, integer: None, measure: Measure::Unit(unit) })
}

fn misfit(why: ValueMismatch) -> EntryError {
    EntryError::ValueMismatch(why.0, why.1)
}

/// The number in a text, and the unit after it.
fn written(text: &str) -> Result<Written<'_>, EntryError> {
    let text = text.trim();
    let raw = text.strip_prefix("raw").filter(|rest| rest.starts_with([' ', '+', '-']));
    let rest = raw.map_or(text, str::trim_start);
    let length = number_length(rest);
    let (number, unit) = rest.split_at_checked(length).ok_or(EntryError::NoNumber)?;
    let number = number.replace('_', "").parse::<f64>().ok();
    let number = number.filter(|number| number.is_finite()).ok_or(EntryError::NoNumber)?;
    let unit = unit.trim();
    if raw.is_some() && !unit.is_empty() {
        let message = "a code has no unit".to_owned();
        return Err(EntryError::ValueMismatch(
            message,
            "write the code alone: `raw 307`".to_owned(),
        ));
    }
    Ok(Written { number, unit, is_raw: raw.is_some() })
}

/// The length of the number that a text begins with.
fn number_length(text: &str) -> usize {
    let is_digit = |c: char| c.is_ascii_digit() || c == '.' || c == '_';
    let digits = |from: usize| {
        let rest = text.get(from..).unwrap_or_default();
        from + rest.find(|c| !is_digit(c)).unwrap_or(rest.len())
    };
    let end = digits(usize::from(text.starts_with(['+', '-'])));
    let rest = text.get(end..).unwrap_or_default();
    let Some(exponent) = rest.strip_prefix(['e', 'E']) else { return end };
    let sign = usize::from(exponent.starts_with(['+', '-']));
    let is_exponent =
        exponent.get(sign..).is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_digit()));
    if is_exponent { digits(end + 1 + sign) } else { end }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parts(text: &str) -> Option<(f64, &str, bool)> {
        written(text).ok().map(|one| (one.number, one.unit, one.is_raw))
    }

    #[test]
    fn a_number_ends_where_its_unit_begins() {
        assert_eq!(parts("1500 us"), Some((1500.0, "us", false)));
        assert_eq!(parts(" -20% "), Some((-20.0, "%", false)));
        assert_eq!(parts("1_000 m/s^2"), Some((1000.0, "m/s^2", false)));
        assert_eq!(parts("1.5e-3 V"), Some((0.0015, "V", false)));
        assert_eq!(parts("2 erpm"), Some((2.0, "erpm", false)));
        assert_eq!(parts("raw 307"), Some((307.0, "", true)));
        assert_eq!(parts("raw -20"), Some((-20.0, "", true)));
        for wrong in ["", "raw", "rawhide", "us", "--1", "1.2.3", "raw 5 ms", "1e999", "µ"] {
            assert_eq!(parts(wrong), None, "{wrong}");
        }
    }
}
