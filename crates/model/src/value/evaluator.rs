//! Expressions in, computed values out: names of constants are replaced, and operations are done.
//!
//! A number may have a unit. Numbers with units are multiplied and divided as in physics, and added
//! only to numbers of the same dimension.

use sensedsl_diagnostics::codes::{e0211_out_of_range, e0227_cannot_compute as cannot};
use sensedsl_diagnostics::{Diagnostic, FileId, Span, nearest};
use sensedsl_limits::{CONSTANT_PARTS_MAX, TEXT_BYTES_MAX};
use sensedsl_syntax::ast::{self, AstNode as _, Magnitude, Operator, Sign};

use super::constants::Constants;
use super::dimension::Dimension;
use super::{Measure, Number, Value};
use crate::spanned::{Spanned, span};

/// Replaces constants by their values, and computes.
pub(crate) struct Evaluator<'a> {
    file: FileId,
    constants: &'a Constants,
    diagnostics: &'a mut Vec<Diagnostic>,
    /// How much constants may still add to the value. Without a limit, constants that are lists of
    /// lists could double in size with each step.
    left: usize,
}

impl<'a> Evaluator<'a> {
    pub(crate) fn new(
        file: FileId,
        constants: &'a Constants,
        diagnostics: &'a mut Vec<Diagnostic>,
    ) -> Self {
        Self { file, constants, diagnostics, left: CONSTANT_PARTS_MAX }
    }

    /// The value of a constant, if there is room for it.
    fn constant(&mut self, name: &ast::Name) -> Option<Value> {
        let value = self.constants.get(name.text())?;
        let Some(left) = self.left.checked_sub(value.parts()) else {
            // Reported once; anything after it is too much as well.
            if self.left > 0 {
                let at = span(self.file, name.range());
                let message = "constants make this value too large";
                let help = "write what is meant, or split it";
                self.diagnostics.push(cannot::cannot_compute(at, message, help));
            }
            self.left = 0;
            return Some(Value::Unknown);
        };
        self.left = left;
        Some(value.clone())
    }

    /// The computed value, with its place.
    pub(crate) fn spanned(&mut self, node: &ast::Value) -> Spanned<Value> {
        Spanned { value: self.value(node), span: self.span(node) }
    }

    fn span(&self, node: &ast::Value) -> Span {
        span(self.file, node.range())
    }

    /// The computed value of a node.
    pub(crate) fn value(&mut self, node: &ast::Value) -> Value {
        match node {
            ast::Value::Number(number) => literal(number),
            ast::Value::Name(name) => match name.name() {
                Some(name) => {
                    self.constant(&name).unwrap_or_else(|| Value::Name(name.text().to_owned()))
                }
                None => Value::Unknown,
            },
            ast::Value::String(text) => self.text(text),
            ast::Value::List(list) => {
                Value::List(list.values().map(|one| self.spanned(&one)).collect())
            }
            ast::Value::Range(range) => match (range.first(), range.last()) {
                (Some(first), Some(last)) => {
                    Value::Range(Box::new([self.spanned(&first), self.spanned(&last)]))
                }
                _ => Value::Unknown,
            },
            ast::Value::Paren(paren) => {
                paren.value().map_or(Value::Unknown, |inner| self.value(&inner))
            }
            ast::Value::Signed(signed) => self.signed(signed),
            ast::Value::Binary(binary) => self.binary(binary),
        }
    }

    fn text(&mut self, node: &ast::StringValue) -> Value {
        let length = usize::from(node.range().len());
        if length > TEXT_BYTES_MAX {
            let at = span(self.file, node.range());
            let (found, range) =
                (format!("{length} letters"), format!("up to {TEXT_BYTES_MAX} letters"));
            let report = e0211_out_of_range::out_of_range;
            self.diagnostics.push(report(at, "a text", &found, &range));
            return Value::Unknown;
        }
        node.literal().map_or(Value::Unknown, |text| Value::Text(text.value()))
    }

    fn signed(&mut self, signed: &ast::Signed) -> Value {
        let Some(inner) = signed.value() else { return Value::Unknown };
        let Some(number) = self.operand(&inner) else { return Value::Unknown };
        if signed.sign() == Some(Sign::Minus) {
            let integer = number.integer.and_then(i128::checked_neg);
            return Value::Number(Number { value: -number.value, integer, ..number });
        }
        Value::Number(number)
    }

    /// Computes a chain of operations, from the left. The chain may be long, so this does not
    /// recurse.
    fn binary(&mut self, binary: &ast::Binary) -> Value {
        let mut rest = vec![binary.clone()];
        let mut left = binary.left();
        while let Some(ast::Value::Binary(inner)) = &left {
            let inner = inner.clone();
            left = inner.left();
            rest.push(inner);
        }
        let Some(first) = left else { return Value::Unknown };
        let mut so_far = self.operand(&first);
        for operation in rest.iter().rev() {
            let right = operation.right().and_then(|right| self.operand(&right));
            let (Some(left), Some(right), Some(operator)) = (so_far, right, operation.operator())
            else {
                return Value::Unknown;
            };
            match compute(left, operator, right) {
                Ok(number) => so_far = Some(number),
                Err(why) => {
                    let at = span(self.file, operation.range());
                    self.diagnostics.push(cannot::cannot_compute(at, &why.message, why.help));
                    return Value::Unknown;
                }
            }
        }
        so_far.map_or(Value::Unknown, Value::Number)
    }

    /// The operand as a number; anything else is reported.
    fn operand(&mut self, node: &ast::Value) -> Option<Number> {
        let at = self.span(node);
        match self.value(node) {
            Value::Number(number) => Some(number),
            Value::Unknown => None,
            Value::Name(name) => {
                let meant = nearest(&name, self.constants.names());
                self.diagnostics.push(cannot::not_a_constant(at, &name, meant));
                None
            }
            Value::Text(_) | Value::List(_) | Value::Range(_) => {
                let message = "this is not a number";
                let help = "compute with numbers and with constants that are numbers";
                self.diagnostics.push(cannot::cannot_compute(at, message, help));
                None
            }
        }
    }
}

/// The value of a number as it is written.
pub(crate) fn literal(number: &ast::Number) -> Value {
    let is_negative = number.sign() == Some(Sign::Minus);
    let measure = match (number.unit_token(), number.unit()) {
        (None, _) => Measure::Bare,
        (Some(_), Some(unit)) => Measure::Unit(unit),
        (Some(_), None) => return Value::Unknown,
    };
    // `raw 5 ms` is always refused: it is valid neither as a time nor as a code.
    let measure = match measure {
        Measure::Bare if number.is_raw() => Measure::Raw,
        Measure::Unit(unit) if number.is_raw() => {
            Measure::Derived(Dimension::of(unit).combine(Dimension::RAW, i8::saturating_add))
        }
        Measure::Bare | Measure::Raw | Measure::Unit(_) | Measure::Derived(_) => measure,
    };
    let (value, integer) = match number.magnitude() {
        Some(Magnitude::Integer(value)) =>
        {
            #[expect(clippy::cast_precision_loss, reason = "the exact number stands beside it")]
            (value as f64, Some(i128::from(value)))
        }
        Some(Magnitude::Float(value)) => (value, None),
        None => return Value::Unknown,
    };
    let signed = if is_negative { (-value, integer.map(|one| -one)) } else { (value, integer) };
    let integer = signed.1.filter(|_| measure == Measure::Bare);
    Value::Number(Number { value: signed.0, integer, measure })
}

/// Why two numbers cannot be combined.
struct CombineError {
    message: String,
    help: &'static str,
}

/// Two numbers and an operator in, the result, or what is wrong and what to write, out.
pub(crate) fn combine(
    left: Number,
    operator: Operator,
    right: Number,
) -> Result<Number, (String, &'static str)> {
    compute(left, operator, right).map_err(|why| (why.message, why.help))
}

fn compute(left: Number, operator: Operator, right: Number) -> Result<Number, CombineError> {
    let (one, other) = (left.dimension(), right.dimension());
    let bare = left.measure == Measure::Bare && right.measure == Measure::Bare;
    let exact = left.integer.zip(right.integer).filter(|_| bare);
    let number = match operator {
        Operator::Add | Operator::Subtract => {
            if one != other {
                let (one, other) = (left.unit_name(), right.unit_name());
                return Err(CombineError {
                    message: format!("a number of {one} and a number of {other} cannot be added"),
                    help: "give both the same kind of unit",
                });
            }
            let sign = if operator == Operator::Add { 1.0 } else { -1.0 };
            if left.measure == right.measure {
                Number::of(left.value + sign * right.value, left.measure)
            } else {
                let sum = left.in_base_units() + sign * right.in_base_units();
                Number::of(sum, Measure::Derived(one))
            }
        }
        Operator::Multiply if right.measure == Measure::Bare => {
            Number::of(left.value * right.value, left.measure)
        }
        Operator::Multiply if left.measure == Measure::Bare => {
            Number::of(left.value * right.value, right.measure)
        }
        Operator::Multiply => {
            let dimension = one.combine(other, i8::saturating_add);
            let product = left.in_base_units() * right.in_base_units();
            Number::of(product, Measure::Derived(dimension))
        }
        Operator::Divide if right.value == 0.0 => {
            let (message, help) = ("this divides by zero".to_owned(), "divide by another number");
            return Err(CombineError { message, help });
        }
        Operator::Divide if right.measure == Measure::Bare => {
            Number::of(left.value / right.value, left.measure)
        }
        Operator::Divide => {
            let dimension = one.combine(other, i8::saturating_sub);
            let quotient = left.in_base_units() / right.in_base_units();
            Number::of(quotient, Measure::Derived(dimension))
        }
    };
    let exactly = exact.and_then(|(left, right)| match operator {
        Operator::Add => left.checked_add(right),
        Operator::Subtract => left.checked_sub(right),
        Operator::Multiply => left.checked_mul(right),
        Operator::Divide => (left % right == 0).then_some(left / right),
    });
    if !number.value.is_finite() || number.value.abs() > LARGEST {
        let message = "the result is too large".to_owned();
        return Err(CombineError { message, help: "stay below 2^64" });
    }
    Ok(Number { integer: exactly.or(number.integer), ..number })
}

/// The largest number in the language, 2^64.
const LARGEST: f64 = 18_446_744_073_709_551_616.0;
