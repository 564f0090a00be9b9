//! Values that are not quantities: a value in; a number without a unit, a name, a text, bytes or points out.

use crate::kind::uart::exchange::is_address;
use crate::spanned::Spanned;
use crate::value::{Measure, Number, Value};

/// A number without a unit.
pub(crate) fn plain_number(value: &Value) -> Option<f64> {
    match value {
        Value::Number(number) if number.measure == Measure::Bare => Some(number.value),
        Value::Number(_)
        | Value::Name(_)
        | Value::Text(_)
        | Value::List(_)
        | Value::Range(_)
        | Value::Unknown => None,
    }
}

/// A whole number without a unit.
pub(crate) fn plain_integer(value: &Value) -> Option<i128> {
    match value {
        Value::Number(number) => number.integer,
        Value::Name(_) | Value::Text(_) | Value::List(_) | Value::Range(_) | Value::Unknown => None,
    }
}

/// Whether a text is a whole number as the language has it.
pub(super) fn is_plain_number(text: &str) -> bool {
    let hex = text.strip_prefix("0x").map(|digits| u64::from_str_radix(digits, 16).is_ok());
    hex.unwrap_or_else(|| text.parse::<u64>().is_ok())
}

/// The text of a name or a string.
pub(crate) fn name_or_text(value: &Value) -> Option<String> {
    match value {
        Value::Name(text) | Value::Text(text) => Some(text.clone()),
        Value::Number(_) | Value::List(_) | Value::Range(_) | Value::Unknown => None,
    }
}

/// The points of a curve; none unless they are pairs whose first numbers ascend.
pub(crate) fn points(value: &Value) -> Option<Vec<(f64, f64)>> {
    let point = |value: &Spanned<Value>| match value.value.list()? {
        [x, y] => Some((plain_number(&x.value)?, plain_number(&y.value)?)),
        _ => None,
    };
    let points: Option<Vec<(f64, f64)>> =
        value.list().and_then(|list| list.iter().map(point).collect());
    let rises = |points: &Vec<(f64, f64)>| {
        points.len() >= 2
            && points.iter().zip(points.iter().skip(1)).all(|(one, next)| one.0 < next.0)
    };
    points.filter(rises)
}

/// The same list with a number where a word stands for the part's address.
pub(crate) fn with_address(value: &Value, address: Option<u8>) -> Value {
    let (Some(list), Some(address)) = (value.list(), address) else { return value.clone() };
    let number =
        Number { value: address.into(), integer: Some(address.into()), measure: Measure::Bare };
    let one = |one: &Spanned<Value>| Spanned {
        value: if is_address(&one.value) { Value::Number(number) } else { one.value.clone() },
        span: one.span,
    };
    Value::List(list.iter().map(one).collect())
}

pub(super) fn byte_list(value: &Value) -> Option<Vec<i128>> {
    match value {
        Value::List(list) => list.iter().map(|one| plain_integer(&one.value)).collect(),
        Value::Text(text) => Some(text.bytes().map(i128::from).collect()),
        Value::Number(_) => Some(vec![plain_integer(value)?]),
        Value::Name(_) | Value::Range(_) | Value::Unknown => None,
    }
}

/// What sort of value it is, for messages.
pub(super) fn describe(value: &Value) -> &'static str {
    match value {
        Value::Number(number) if number.measure == Measure::Raw => "a code",
        Value::Number(number) if number.measure != Measure::Bare => "a number with a unit",
        Value::Number(number) if number.integer.is_none() => "a number with a fraction",
        Value::Number(_) => "a number",
        Value::Name(_) => "a name",
        Value::Text(_) => "a text",
        Value::List(list) if list.iter().any(|one| plain_integer(&one.value).is_none()) => {
            "a list of something else"
        }
        Value::List(_) => "a list",
        Value::Range(_) => "a range",
        Value::Unknown => "an expression",
    }
}
