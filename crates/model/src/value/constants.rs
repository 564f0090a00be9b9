//! The values of constants by name, which expressions look up; what expressions come to, for people.

use std::collections::BTreeMap;

use sensedsl_diagnostics::FileId;
use sensedsl_syntax::{Unit, ast};

use super::written::{rounded, shown_hz};
use super::{Dimension, Evaluator, Measure, Number, Value};

/// All constants by name.
#[derive(Clone, Debug, Default)]
pub struct Constants {
    pub(super) values: BTreeMap<String, Value>,
}

impl Constants {
    /// What an expression of a file comes to, for people: `20 ms`, `400 kHz`, `[1, 2]`. None if it is not a number, a
    /// range or a list of such, or cannot be computed.
    #[must_use]
    pub fn computed(&self, file: FileId, expression: &ast::Value) -> Option<String> {
        shown(&Evaluator::new(file, self, &mut Vec::new()).value(expression))
    }

    /// The value of a constant.
    pub(crate) fn get(&self, name: &str) -> Option<&Value> {
        self.values.get(name)
    }

    /// The names of the constants.
    pub(crate) fn names(&self) -> impl Iterator<Item = &str> + Clone {
        self.values.keys().map(String::as_str)
    }
}

fn shown(value: &Value) -> Option<String> {
    match value {
        Value::Number(number) => Some(quantity(number)),
        Value::List(all) => {
            let all: Option<Vec<String>> = all.iter().map(|one| shown(&one.value)).collect();
            Some(format!("[{}]", all?.join(", ")))
        }
        Value::Range(ends) => {
            let [first, last] = ends.as_ref();
            Some(format!("{}..{}", shown(&first.value)?, shown(&last.value)?))
        }
        Value::Name(_) | Value::Text(_) | Value::Unknown => None,
    }
}

/// A number with its unit. What was computed in seconds or hertz is told in the units that people write.
fn quantity(number: &Number) -> String {
    let Number { value, integer, measure } = *number;
    let digits = integer.map_or_else(|| rounded(value), |whole| whole.to_string());
    match measure {
        Measure::Bare => digits,
        Measure::Raw => format!("raw {digits}"),
        Measure::Unit(_) => format!("{digits} {}", number.unit_name()),
        Measure::Derived(dimension) if dimension == Dimension::of(Unit::Seconds) => {
            match value.abs() {
                ..0.001 => format!("{} us", rounded(value * 1e6)),
                ..1.0 => format!("{} ms", rounded(value * 1e3)),
                _ => format!("{digits} s"),
            }
        }
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a whole number of that size"
        )]
        Measure::Derived(dimension)
            if dimension == Dimension::of(Unit::Hertz)
                && value.fract() == 0.0
                && (0.0..=f64::from(u32::MAX)).contains(&value) =>
        {
            shown_hz(value as u32)
        }
        Measure::Derived(dimension) if dimension == Dimension::of(Unit::Hertz) => {
            format!("{digits} Hz")
        }
        Measure::Derived(_) => format!("{digits} {}", number.unit_name()),
    }
}
