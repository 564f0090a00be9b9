//! Shown values: what a person gives for a device in, the code that goes over the wire out.
//!
//! A bare number is in the unit that the device shows, `raw 307` is a code, and a number with a
//! unit is converted if the units fit.

use sensedsl_diagnostics::codes::{e0234_value_does_not_fit as misfit, h0707_of_ten_thousand};
use sensedsl_syntax::Unit;
use sensedsl_syntax::ast::{self, AstNode as _};

#[cfg(test)]
use super::asked;
use super::{Field, Fields, plain_number, points};
use crate::design::{Bare, Presentation};
#[cfg(test)]
use crate::meaning::Takes;
use crate::spanned::Spanned;
use crate::value::written::rounded;
use crate::value::{Dimension, Measure, Number, Value, power_of_ten, shifted};

/// Codes per percent of a pwm output's range.
const CODES_OF_PERCENT: f64 = 100.0;
/// Codes of the whole range.
const CODES: f64 = 10_000.0;

/// The codes that a value can have.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Codes {
    /// The least and the greatest code that the type holds and the part takes; none if that is not
    /// known.
    pub(crate) range: Option<(f64, f64)>,
    /// Whether codes are whole numbers.
    pub(crate) is_whole: bool,
    /// The pulses of the least and the greatest code, in microseconds, of a pwm output on its own.
    pub(crate) pulses_us: Option<(f64, f64)>,
}

/// Why a number is not a value of the device: what is wrong, and what to write.
pub(crate) struct ValueMismatch(pub(crate) String, pub(crate) String);

impl Fields<'_> {
    /// The bare number that was taken as a shown value, if one was.
    pub(crate) fn take_bare(&mut self) -> Option<Bare> {
        self.bare.take()
    }

    /// Whether a number for the block is always its code, because the block has no conversion, unit
    /// or bounds.
    pub(crate) fn shows_the_code(&self) -> bool {
        ["quantity", "scale", "offset", "curve", "min", "max"].iter().all(|name| !self.has(name))
    }

    /// A number without a unit, or a code.
    #[expect(clippy::unused_self, reason = "beside the other ways to read a field")]
    pub(crate) fn plain_or_raw(&self, field: &Field) -> Option<f64> {
        let raw = field.value.number().filter(|number| number.measure == Measure::Raw);
        plain_number(&field.value).or_else(|| raw.map(|number| number.value))
    }

    /// How the block shows its value, without taking the properties.
    fn peek_shown(&self, is_pwm: bool) -> Presentation {
        let number = |name: &str| plain_number(&self.field(name)?.value);
        let curve = self.field("curve").and_then(|field| points(&field.value));
        let shown = Presentation {
            quantity: self.peek_name("quantity"),
            scale: number("scale"),
            offset: number("offset"),
            curve: curve.unwrap_or_default(),
            ..Presentation::default()
        };
        // For a pwm output they are pulses.
        let bound = |name: &str| {
            let number = self.field(name).filter(|_| !is_pwm)?.value.number();
            number.and_then(|number| in_quantity(number, &shown).ok())
        };
        let (min, max) = (bound("min"), bound("max"));
        Presentation { min, max, ..shown }
    }

    /// Takes a bound of the shown value.
    pub(crate) fn bound(&mut self, name: &str) -> Option<Spanned<f64>> {
        #[cfg(test)]
        asked::takes(name, &Takes::Bound);
        let field = self.take(name)?;
        let number = field.value.number().filter(|number| number.measure != Measure::Raw);
        let Some(number) = number else {
            self.wrong(&field, "a number, in the unit that is shown");
            return None;
        };
        match in_quantity(number, &self.peek_shown(true)) {
            Ok(value) => Some(Spanned { value, span: field.value_span }),
            Err(ValueMismatch(message, help)) => {
                let message = format!("`{name}`: {message}");
                self.say(misfit::value_does_not_fit(field.value_span, &message, &help, None));
                None
            }
        }
    }

    /// Takes a value that a person gives for the device, and returns its code.
    pub(crate) fn code(&mut self, name: &str, codes: Codes) -> Option<Spanned<f64>> {
        #[cfg(test)]
        asked::takes(name, &Takes::Shown);
        let field = self.take(name)?;
        let Value::Number(number) = &field.value else {
            self.wrong(&field, "a number, in the unit that is shown, or a code such as raw 307");
            return None;
        };
        let shown = self.peek_shown(codes.pulses_us.is_some());
        let (number, at) = (*number, field.value_span);
        match code_of(&number, &shown, codes) {
            Ok(code) => {
                let is_pulse = codes.pulses_us.is_some() && shown.quantity.is_none();
                let is_small = code.abs() >= 1.0 && code.abs() <= CODES_OF_PERCENT;
                if is_pulse && is_small && number.measure == Measure::Bare && shown.is_plain() {
                    let percent = (code / CODES_OF_PERCENT).to_string();
                    let report = h0707_of_ten_thousand::of_ten_thousand;
                    self.say(report(at, &number.value.to_string(), &percent));
                }
                self.note_bare(&number, &shown, Spanned { value: code, span: at });
                Some(Spanned { value: code, span: at })
            }
            Err(ValueMismatch(message, help)) => {
                let message = format!("`{name}`: {message}");
                // Files of older versions have codes there without saying so.
                let as_code = Number { measure: Measure::Raw, ..number };
                let is_code = number.measure == Measure::Bare
                    && matches!(field.node, ast::Value::Number(_))
                    && code_of(&as_code, &shown, codes).is_ok();
                let written = field.node.syntax().text().to_string();
                let code = is_code.then(|| written.trim());
                self.say(misfit::value_does_not_fit(at, &message, &help, code));
                None
            }
        }
    }

    fn note_bare(&mut self, number: &Number, shown: &Presentation, code: Spanned<f64>) {
        let is_other = number.measure == Measure::Bare && (number.value - code.value).abs() > 1e-9;
        if is_other && !shown.is_plain() {
            let unit = shown.quantity.as_deref().and_then(unit_of);
            let with_unit = unit.map(|unit| format!("{} {unit}", number.value));
            let (span, number) = (code.span, number.value);
            self.bare = Some(Bare { span, number, code: code.value, with_unit });
        }
    }
}

/// The language's unit for a device's quantity.
pub(crate) fn unit_of(quantity: &str) -> Option<Unit> {
    match quantity {
        "percent" => Some(Unit::Percent),
        "°" => Some(Unit::Degrees),
        "°C" => Some(Unit::Celsius),
        "µs" | "μs" => Some(Unit::Microseconds),
        other => Unit::from_name(other),
    }
}

/// The code of a number that a person gives for a device.
pub(crate) fn code_of(
    number: &Number,
    shown: &Presentation,
    codes: Codes,
) -> Result<f64, ValueMismatch> {
    if number.measure == Measure::Raw {
        return held(number.value, number.value, "raw ", codes, None);
    }
    let is_pwm = codes.pulses_us.is_some() && shown.quantity.is_none() && shown.is_plain();
    if is_pwm && number.measure != Measure::Bare {
        return of_pulse(number, codes);
    }
    let value = in_quantity(number, shown)?;
    let unit = shown.quantity.clone();
    bounded(value, shown)?;
    if shown.is_plain() {
        return held(value, value, "", codes, unit.as_deref());
    }
    let Some(raw) = shown.raw_of(value) else {
        let message = format!("{} is never shown by this device", with(value, unit.as_deref()));
        return Err(ValueMismatch(message, "write a value that `curve` reaches".to_owned()));
    };
    let code = if codes.is_whole { raw.round() } else { raw };
    within(code, codes, shown, &with(value, unit.as_deref()))
}

/// The code of a percentage or pulse of a pwm output that shows nothing else.
pub(crate) fn of_pulse(number: &Number, codes: Codes) -> Result<f64, ValueMismatch> {
    let (least, most) = codes.pulses_us.unwrap_or((0.0, CODES));
    let help = format!("write 0 to 10000, 0 % to 100 %, or a pulse of {least} us to {most} us");
    let found = with(number.value, Some(&number.unit_name()));
    let code = match number.measure {
        Measure::Unit(Unit::Percent) => number.value * CODES_OF_PERCENT,
        Measure::Bare | Measure::Derived(_) | Measure::Raw | Measure::Unit(_)
            if number.dimension() == Dimension::TIME =>
        {
            CODES * (shifted_us(number) - least) / (most - least)
        }
        Measure::Bare | Measure::Derived(_) | Measure::Raw | Measure::Unit(_) => {
            return Err(ValueMismatch(format!("{found} is not a value of a pwm output"), help));
        }
    };
    if codes.range.is_some_and(|(least, most)| !(code >= least && code <= most)) {
        return Err(ValueMismatch(format!("{found} is out of reach"), help));
    }
    Ok(if codes.is_whole { code.round() } else { code })
}

fn shifted_us(number: &Number) -> f64 {
    match number.measure {
        Measure::Unit(unit) => shifted(number.value, power_of_ten(unit) + 6),
        Measure::Bare | Measure::Derived(_) | Measure::Raw => number.in_base_units() * 1e6,
    }
}

/// The number in the unit that the device shows.
pub(crate) fn in_quantity(number: &Number, shown: &Presentation) -> Result<f64, ValueMismatch> {
    let given = match number.measure {
        Measure::Bare => return Ok(number.value),
        Measure::Unit(unit) => Some(unit),
        Measure::Derived(_) | Measure::Raw => None,
    };
    let found = number.unit_name();
    let Some(quantity) = &shown.quantity else {
        let message = format!("the value has no unit, and this is a number of {found}");
        let help = "write the number alone, or give the device its `quantity`".to_owned();
        return Err(ValueMismatch(message, help));
    };
    let wanted = unit_of(quantity).filter(|wanted| Dimension::of(*wanted) == number.dimension());
    match (wanted, given) {
        (Some(wanted), Some(given)) => {
            Ok(shifted(number.value, power_of_ten(given) - power_of_ten(wanted)))
        }
        (Some(wanted), None) => Ok(shifted(number.in_base_units(), -power_of_ten(wanted))),
        (None, _) => {
            let message = format!("the device shows {quantity}, and this is a number of {found}");
            Err(ValueMismatch(message, format!("write it in {quantity}, or as a code: `raw 307`")))
        }
    }
}

/// Refuses a value outside `min` and `max`.
fn bounded(value: f64, shown: &Presentation) -> Result<(), ValueMismatch> {
    let unit = shown.quantity.as_deref();
    let is_below = shown.min.is_some_and(|min| value < min);
    if !is_below && shown.max.is_none_or(|max| value <= max) {
        return Ok(());
    }
    let (which, bound) =
        if is_below { ("below `min`", shown.min) } else { ("above `max`", shown.max) };
    let bound = with(bound.unwrap_or_default(), unit);
    let message = format!("{} is {which}, {bound}", with(value, unit));
    let help = match unit {
        Some(unit) => format!(
            "a number is in {unit}, as it is shown: stay within the bounds, or write a code: `raw 307`"
        ),
        None => {
            "stay within the bounds; a number is as it is shown, and `raw 307` is a code".to_owned()
        }
    };
    Err(ValueMismatch(message, help))
}

/// Checks a code that is written as one.
fn held(
    code: f64,
    value: f64,
    before: &str,
    codes: Codes,
    unit: Option<&str>,
) -> Result<f64, ValueMismatch> {
    let is_whole = !codes.is_whole || code.fract() == 0.0;
    let is_within = codes.range.is_none_or(|(least, most)| code >= least && code <= most);
    if is_whole && is_within {
        return Ok(code);
    }
    let message = format!("{before}{} is not a value of this device", with(value, unit));
    let kind = if codes.is_whole { "whole numbers" } else { "numbers" };
    let help = match codes.range {
        Some((least, most)) => format!("its codes are {kind} from {least} to {most}"),
        None => format!("its codes are {kind}"),
    };
    Err(ValueMismatch(message, help))
}

/// Refuses a shown value whose code does not exist.
fn within(
    code: f64,
    codes: Codes,
    shown: &Presentation,
    value: &str,
) -> Result<f64, ValueMismatch> {
    let Some((least, most)) =
        codes.range.filter(|(least, most)| !(code >= *least && code <= *most))
    else {
        return Ok(code);
    };
    let (one, other) = (shown.of_raw(least), shown.of_raw(most));
    let unit = shown.quantity.as_deref();
    let range = format!(
        "{} to {}",
        with(rounded(one.min(other)), unit),
        with(rounded(one.max(other)), unit)
    );
    let message = format!("{value} is out of reach: the value goes from {range}");
    Err(ValueMismatch(message, "write the value as it is shown, or a code: `raw 307`".to_owned()))
}

fn with(value: impl std::fmt::Display, unit: Option<&str>) -> String {
    unit.map_or_else(|| value.to_string(), |unit| format!("{value} {unit}"))
}
