//! Values: what a file writes after `=`, computed. Numbers keep their units, so that whoever takes one knows what it
//! measures.

pub(crate) mod constants;
pub(crate) mod definitions;
mod dimension;
mod evaluator;
pub(crate) mod other_types;
pub(crate) mod types;
pub mod written;

use sensedsl_syntax::Unit;

use crate::spanned::Spanned;

pub(crate) use dimension::{Dimension, power_of_ten, shifted};
pub(crate) use evaluator::{Evaluator, combine, literal};

/// A value.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Value {
    /// A number with its unit.
    Number(Number),
    /// A name: a pin, a kind, `true`.
    Name(String),
    /// A text.
    Text(String),
    /// Several values.
    List(Vec<Spanned<Value>>),
    /// A range from the first to the last.
    Range(Box<[Spanned<Value>; 2]>),
    /// A value that could not be read or computed; that has been reported.
    Unknown,
}

impl Value {
    /// The values of a list.
    pub(crate) fn list(&self) -> Option<&[Spanned<Value>]> {
        if let Self::List(list) = self { Some(list) } else { None }
    }

    /// The value as a text between quotes.
    pub(crate) fn text(&self) -> Option<&String> {
        if let Self::Text(text) = self { Some(text) } else { None }
    }

    /// The value as a number.
    pub(crate) fn number(&self) -> Option<&Number> {
        if let Self::Number(number) = self { Some(number) } else { None }
    }

    /// The number of its numbers, words and letters; never 0.
    pub(super) fn parts(&self) -> usize {
        match self {
            Self::Number(_) | Self::Unknown => 1,
            Self::Name(text) | Self::Text(text) => 1 + text.len(),
            Self::List(list) => 1 + list.iter().map(|one| one.value.parts()).sum::<usize>(),
            Self::Range(ends) => ends.iter().map(|one| one.value.parts()).sum(),
        }
    }

    /// The ends of a range.
    pub(crate) fn range(&self) -> Option<&[Spanned<Value>; 2]> {
        if let Self::Range(ends) = self { Some(ends) } else { None }
    }
}

/// A number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Number {
    /// The number in its unit.
    pub(crate) value: f64,
    /// The exact number, if it is whole and has no unit.
    pub(crate) integer: Option<i128>,
    /// What the number measures.
    pub(crate) measure: Measure,
}

/// What a number measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Measure {
    /// No unit.
    Bare,
    /// A unit of the language.
    Unit(Unit),
    /// Seconds, volts, ohms and so on, each to a power.
    Derived(Dimension),
    /// A code: what goes over the wire, not the shown value.
    Raw,
}

impl Number {
    /// The dimension of the number.
    pub(crate) fn dimension(&self) -> Dimension {
        match self.measure {
            Measure::Bare => Dimension::NONE,
            Measure::Unit(unit) => Dimension::of(unit),
            Measure::Derived(dimension) => dimension,
            Measure::Raw => Dimension::RAW,
        }
    }

    /// The number in base units, such as seconds, hertz, volts or ohms.
    pub(crate) fn in_base_units(&self) -> f64 {
        match self.measure {
            Measure::Bare | Measure::Derived(_) | Measure::Raw => self.value,
            Measure::Unit(unit) => shifted(self.value, power_of_ten(unit)),
        }
    }

    /// The name of the unit, for messages.
    pub(crate) fn unit_name(&self) -> String {
        match self.measure {
            Measure::Bare => "no unit".to_owned(),
            Measure::Raw => "raw".to_owned(),
            Measure::Unit(unit) => unit.name().to_owned(),
            Measure::Derived(dimension) => {
                let powers = [
                    ("V", dimension.volts),
                    ("Ohm", dimension.ohms),
                    ("A", dimension.amperes),
                    ("W", dimension.watts),
                    ("m", dimension.metres),
                    ("deg", dimension.degrees),
                    ("degC", dimension.celsius),
                    ("rpm", dimension.turns),
                    ("%", dimension.percents),
                    ("raw", dimension.raws),
                    ("s", dimension.seconds),
                ];
                let words = |sign: i8| {
                    let word = move |(unit, power): (&str, i8)| match power.saturating_mul(sign) {
                        ..1 => None,
                        1 => Some(unit.to_owned()),
                        power => Some(format!("{unit}^{power}")),
                    };
                    powers.into_iter().filter_map(word).collect::<Vec<_>>().join(" ")
                };
                match (words(1), words(-1)) {
                    (above, below) if below.is_empty() => above,
                    (above, below) if above.is_empty() => format!("1/{below}"),
                    (above, below) => format!("{above}/{below}"),
                }
            }
        }
    }

    pub(crate) fn of(value: f64, measure: Measure) -> Self {
        let is_none = measure == Measure::Derived(Dimension::NONE);
        let measure = if is_none { Measure::Bare } else { measure };
        let is_whole = measure == Measure::Bare && value.fract() == 0.0 && value.abs() < EXACT_MAX;
        #[expect(clippy::cast_possible_truncation, reason = "whole and far within i128")]
        let integer = is_whole.then_some(value as i128);
        Self { value, integer, measure }
    }
}

/// Whole numbers up to this one are exact as `f64`.
const EXACT_MAX: f64 = 9_007_199_254_740_992.0;
