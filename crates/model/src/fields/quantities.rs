//! Numbers with units: a property in, microseconds, milliseconds, hertz, millivolts or ohms out.

use std::ops::RangeInclusive;

use sensedsl_diagnostics::codes::e0210_wrong_unit;
use sensedsl_syntax::Unit;
use sensedsl_syntax::ast::Value;

use super::{Field, Fields, signed_magnitude};
use crate::design::Spanned;

impl Fields<'_> {
    /// A time in microseconds; a bare number is milliseconds.
    pub(crate) fn time_us(
        &mut self,
        name: &str,
        range: RangeInclusive<u32>,
    ) -> Option<Spanned<u32>> {
        let (field, us) = self.time(name)?;
        self.whole(&field, us, range, "us")
    }

    /// A cycle time in whole milliseconds.
    pub(crate) fn time_ms(
        &mut self,
        name: &str,
        range: RangeInclusive<u32>,
    ) -> Option<Spanned<u32>> {
        let (field, us) = self.time(name)?;
        self.whole(&field, us / 1000.0, range, "ms")
    }

    /// A frequency in hertz; a bare number is hertz.
    pub(crate) fn frequency_hz(
        &mut self,
        name: &str,
        range: RangeInclusive<u32>,
    ) -> Option<Spanned<u32>> {
        let field = self.take(name)?;
        let hz = self.quantity(&field, Unit::Hertz, &FREQUENCIES, "a frequency such as 400 kHz")?;
        self.whole(&field, hz, range, "Hz")
    }

    /// A pace given as a frequency or as the time of one tick.
    pub(crate) fn rate_hz(
        &mut self,
        name: &str,
        range: RangeInclusive<u32>,
        bare: Unit,
    ) -> Option<Spanned<u32>> {
        let field = self.take(name)?;
        let Value::Number(number) = &field.value else {
            self.wrong(&field, "a frequency such as 1 MHz, or the time of one tick such as 1 us");
            return None;
        };
        let unit = number.unit().unwrap_or(bare);
        let value = signed_magnitude(number)?;
        let hz = match factor(unit) {
            (Dimension::Time, us) => 1_000_000.0 / (value * us),
            (Dimension::Frequency, hz) => value * hz,
            (Dimension::Voltage | Dimension::Resistance, _) => {
                let takes = "Hz, kHz, MHz, us, ms or s";
                let wrong = e0210_wrong_unit::wrong_unit;
                self.diagnostics.push(wrong(field.value_span, &field.name, unit.name(), takes));
                return None;
            }
        };
        self.whole(&field, hz, range, "Hz")
    }

    /// A time as a field and its microseconds; a bare number is milliseconds.
    fn time(&mut self, name: &str) -> Option<(Field, f64)> {
        let field = self.take(name)?;
        let us = self.quantity(&field, Unit::Milliseconds, &TIMES, "a time such as 60 ms")?;
        Some((field, us))
    }

    /// A voltage in millivolts; a bare number is volts.
    pub(crate) fn voltage_mv(
        &mut self,
        name: &str,
        range: RangeInclusive<u32>,
    ) -> Option<Spanned<u32>> {
        let field = self.take(name)?;
        let mv = self.quantity(&field, Unit::Volts, &VOLTAGES, "a voltage such as 5 V")?;
        self.whole(&field, mv, range, "mV")
    }

    /// Two resistances in ohms; bare numbers are ohms.
    pub(crate) fn resistances_ohm(&mut self, name: &str) -> Option<Spanned<[u32; 2]>> {
        const TAKES: &str = "two resistances such as [10 kOhm, 20 kOhm]";
        let field = self.take(name)?;
        let Value::List(list) = &field.value else {
            self.wrong(&field, TAKES);
            return None;
        };
        let values: Vec<Value> = list.values().collect();
        let [upper, lower] = values.as_slice() else {
            self.wrong(&field, TAKES);
            return None;
        };
        let mut ohms = [0; 2];
        for (value, ohm) in [upper, lower].into_iter().zip(&mut ohms) {
            let one = Field { value: value.clone(), ..field.clone() };
            let found = self.quantity(&one, Unit::Ohms, &RESISTANCES, TAKES)?;
            *ohm = self.whole(&one, found, 1..=100_000_000, "Ohm")?.value;
        }
        Some(Spanned { value: ohms, span: field.value_span })
    }

    fn quantity(
        &mut self,
        field: &Field,
        bare: Unit,
        dimension: &(Dimension, &str),
        takes: &str,
    ) -> Option<f64> {
        let Value::Number(number) = &field.value else {
            self.wrong(field, takes);
            return None;
        };
        let unit = number.unit().unwrap_or(bare);
        let (found, factor) = factor(unit);
        if found != dimension.0 {
            self.diagnostics.push(e0210_wrong_unit::wrong_unit(
                field.value_span,
                &field.name,
                unit.name(),
                dimension.1,
            ));
            return None;
        }
        Some(signed_magnitude(number)? * factor)
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
        // Relative to the value: 0.1 s is 100,000.00000000001 us in binary, and 0.7 ms is not 1 ms.
        let whole = (value - rounded).abs() <= 1e-6 * rounded.abs();
        if !(rounded >= least && rounded <= most && whole) {
            let text = format!("a whole number of {unit} from {least} to {most}");
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

#[derive(Clone, Copy, PartialEq, Eq)]
enum Dimension {
    Time,
    Frequency,
    Voltage,
    Resistance,
}

const TIMES: (Dimension, &str) = (Dimension::Time, "us, ms or s");
const FREQUENCIES: (Dimension, &str) = (Dimension::Frequency, "Hz, kHz or MHz");

const VOLTAGES: (Dimension, &str) = (Dimension::Voltage, "mV or V");
const RESISTANCES: (Dimension, &str) = (Dimension::Resistance, "Ohm or kOhm");

/// A unit's dimension and its factor to microseconds, hertz, millivolts or ohms.
fn factor(unit: Unit) -> (Dimension, f64) {
    match unit {
        Unit::Microseconds => (Dimension::Time, 1.0),
        Unit::Milliseconds => (Dimension::Time, 1e3),
        Unit::Seconds => (Dimension::Time, 1e6),
        Unit::Hertz => (Dimension::Frequency, 1.0),
        Unit::Kilohertz => (Dimension::Frequency, 1e3),
        Unit::Megahertz => (Dimension::Frequency, 1e6),
        Unit::Millivolts => (Dimension::Voltage, 1.0),
        Unit::Volts => (Dimension::Voltage, 1e3),
        Unit::Ohms => (Dimension::Resistance, 1.0),
        Unit::Kiloohms => (Dimension::Resistance, 1e3),
    }
}
