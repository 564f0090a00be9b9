//! Numbers with units: a property in, microseconds, milliseconds, hertz, millivolts or ohms out.

use std::ops::RangeInclusive;

use sensedsl_diagnostics::codes::{e0210_wrong_unit, e0211_out_of_range};
use sensedsl_syntax::Unit;

#[cfg(test)]
use super::asked;
use super::{Field, Fields};
#[cfg(test)]
use crate::meaning::Takes;
use crate::spanned::Spanned;
use crate::value::{Dimension, Measure, Number, Value};

impl Fields<'_> {
    /// A time in microseconds; a bare number is milliseconds.
    pub(crate) fn time_us(
        &mut self,
        name: &str,
        range: RangeInclusive<u32>,
    ) -> Option<Spanned<u32>> {
        #[cfg(test)]
        asked::takes(name, &Takes::Time((*range.start()).into(), (*range.end()).into()));
        let (field, us) = self.time(name)?;
        self.whole(&field, us, range, "us")
    }

    /// A cycle time in whole milliseconds.
    pub(crate) fn time_ms(
        &mut self,
        name: &str,
        range: RangeInclusive<u32>,
    ) -> Option<Spanned<u32>> {
        #[cfg(test)]
        asked::takes(name, &Takes::Time(of_ms(*range.start()), of_ms(*range.end())));
        let (field, us) = self.time(name)?;
        self.whole(&field, us / 1000.0, range, "ms")
    }

    /// A frequency in hertz; a bare number is hertz.
    pub(crate) fn frequency_hz(
        &mut self,
        name: &str,
        range: RangeInclusive<u32>,
    ) -> Option<Spanned<u32>> {
        #[cfg(test)]
        asked::takes(name, &Takes::Frequency(*range.start(), *range.end()));
        let field = self.take(name)?;
        let hz = self.quantity(&field, Unit::Hertz, &FREQUENCY, "a frequency such as 400 kHz")?;
        self.whole(&field, hz, range, "Hz")
    }

    /// A rate, given as a frequency or as the time of one tick.
    pub(crate) fn rate_hz(
        &mut self,
        name: &str,
        range: RangeInclusive<u32>,
        bare: Unit,
    ) -> Option<Spanned<u32>> {
        #[cfg(test)]
        asked::takes(name, &Takes::Rate(*range.start(), *range.end()));
        let field = self.take(name)?;
        let Value::Number(number) = &field.value else {
            self.wrong(&field, "a frequency such as 1 MHz, or the time of one tick such as 1 us");
            return None;
        };
        let number = with_unit(number, bare);
        let base = number.in_base_units();
        let hz = if number.dimension() == Dimension::TIME {
            1.0 / base
        } else if number.dimension() == Dimension::FREQUENCY {
            base
        } else {
            let (takes, found) = ("Hz, kHz, MHz, us, ms or s", number.unit_name());
            let wrong = e0210_wrong_unit::wrong_unit;
            self.diagnostics.push(wrong(field.value_span, &field.name, &found, takes, None));
            return None;
        };
        self.whole(&field, hz, range, "Hz")
    }

    /// A time as a field and its microseconds; a bare number is milliseconds.
    fn time(&mut self, name: &str) -> Option<(Field, f64)> {
        let field = self.take(name)?;
        let us = self.quantity(&field, Unit::Milliseconds, &TIME, "a time such as 60 ms")?;
        Some((field, us))
    }

    /// A voltage in millivolts; a bare number is volts.
    pub(crate) fn voltage_mv(
        &mut self,
        name: &str,
        range: RangeInclusive<u32>,
    ) -> Option<Spanned<u32>> {
        #[cfg(test)]
        asked::takes(name, &Takes::Voltage(*range.start(), *range.end()));
        let field = self.take(name)?;
        let mv = self.quantity(&field, Unit::Volts, &VOLTAGE, "a voltage such as 5 V")?;
        self.whole(&field, mv, range, "mV")
    }

    /// Two resistances in ohms; bare numbers are ohms.
    pub(crate) fn resistances_ohm(&mut self, name: &str) -> Option<Spanned<[u32; 2]>> {
        const TAKES: &str = "two resistances such as [10 kOhm, 20 kOhm]";
        #[cfg(test)]
        asked::takes(name, &Takes::Resistances);
        let field = self.take(name)?;
        let Value::List(list) = &field.value else {
            self.wrong(&field, TAKES);
            return None;
        };
        let [upper, lower] = list.as_slice() else {
            self.wrong(&field, TAKES);
            return None;
        };
        let mut ohms = [0; 2];
        for (value, ohm) in [upper, lower].into_iter().zip(&mut ohms) {
            let one = Field { value: value.value.clone(), ..field.clone() };
            let found = self.quantity(&one, Unit::Ohms, &RESISTANCE, TAKES)?;
            *ohm = self.whole(&one, found, 1..=100_000_000, "Ohm")?.value;
        }
        Some(Spanned { value: ohms, span: field.value_span })
    }

    fn quantity(
        &mut self,
        field: &Field,
        bare: Unit,
        quantity: &Quantity,
        takes: &str,
    ) -> Option<f64> {
        let Value::Number(number) = &field.value else {
            self.wrong(field, takes);
            return None;
        };
        let number = with_unit(number, bare);
        if number.dimension() != quantity.dimension {
            let (at, found) = (field.value_span, number.unit_name());
            let wrong = e0210_wrong_unit::wrong_unit;
            let same = same(&number, quantity);
            self.diagnostics.push(wrong(at, &field.name, &found, quantity.units, same.as_deref()));
            return None;
        }
        Some(number.in_base_units() * quantity.per_base)
    }

    fn whole(
        &mut self,
        field: &Field,
        value: f64,
        range: RangeInclusive<u32>,
        unit: &str,
    ) -> Option<Spanned<u32>> {
        let least = f64::from(*range.start());
        let most = f64::from(*range.end());
        let rounded = value.round();
        // The tolerance is relative: 0.1 s is 100,000.00000000001 us in binary, and 0.7 ms is not 1
        // ms.
        let whole = (value - rounded).abs() <= 1e-6 * rounded.abs();
        if !(rounded >= least && rounded <= most && whole) {
            let text = format!("a whole number of {unit} from {least} to {most}");
            let bare = field.value.number().filter(|number| number.measure == Measure::Bare);
            let meant =
                bare.filter(|number| unit == "us" && (least..=most).contains(&number.value));
            if let Some(number) = meant {
                let (at, written) = (field.value_span, number.value.to_string());
                self.say(e0211_out_of_range::bare_time(at, &field.name, &written, &text));
                return None;
            }
            self.out_of_range(field, &format!("{value} {unit}"), &text);
            return None;
        }
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "compared with the u32 range just before"
        )]
        let value = rounded as u32;
        Some(Spanned { value, span: field.value_span })
    }
}

#[cfg(test)]
fn of_ms(ms: u32) -> u64 {
    u64::from(ms) * 1_000
}

/// The time of a frequency, or the frequency of a time, if that is what the quantity is and it is a whole number of one of
/// its units.
fn same(number: &Number, quantity: &Quantity) -> Option<String> {
    let units = match (number.dimension(), quantity.dimension) {
        (Dimension::FREQUENCY, Dimension::TIME) => [(1.0, "s"), (1e-3, "ms"), (1e-6, "us")],
        (Dimension::TIME, Dimension::FREQUENCY) => [(1e6, "MHz"), (1e3, "kHz"), (1.0, "Hz")],
        _ => return None,
    };
    let base = 1.0 / number.in_base_units();
    units.into_iter().find_map(|(factor, unit)| {
        let (value, whole) = (base / factor, (base / factor).round());
        let is_whole = whole >= 1.0 && (value - whole).abs() <= 1e-6 * whole;
        is_whole.then(|| format!("{whole} {unit}"))
    })
}

/// Gives a number without a unit that unit.
fn with_unit(number: &Number, bare: Unit) -> Number {
    match number.measure {
        Measure::Bare => Number { measure: Measure::Unit(bare), ..*number },
        Measure::Unit(_) | Measure::Derived(_) | Measure::Raw => *number,
    }
}

/// A quantity's dimension, the factor from its base unit to microseconds, hertz, millivolts or
/// ohms, and the units that it can be written in.
struct Quantity {
    dimension: Dimension,
    per_base: f64,
    units: &'static str,
}

const TIME: Quantity = Quantity { dimension: Dimension::TIME, per_base: 1e6, units: "us, ms or s" };
const FREQUENCY: Quantity =
    Quantity { dimension: Dimension::FREQUENCY, per_base: 1.0, units: "Hz, kHz or MHz" };
const VOLTAGE: Quantity =
    Quantity { dimension: Dimension::VOLTAGE, per_base: 1e3, units: "mV or V" };
const RESISTANCE: Quantity =
    Quantity { dimension: Dimension::RESISTANCE, per_base: 1.0, units: "Ohm or kOhm" };
