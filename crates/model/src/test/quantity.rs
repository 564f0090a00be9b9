//! Quantities in conditions: what is written in; a term with what it measures, or a constant, out.

use sensedsl_diagnostics::Diagnostic;
use sensedsl_diagnostics::Span;
use sensedsl_diagnostics::codes::{
    e0252_unknown_in_test as unknown, e0253_not_comparable as wrong, e0256_not_a_condition,
};
use sensedsl_diagnostics::nearest;
use sensedsl_rules::Term;
use sensedsl_syntax::ast::{self, AstNode as _, Condition, Operator};

use super::names::{self, Scope};
use super::sort::Sort;
use super::words::FUNCTIONS;
use crate::design::{Device, DeviceIndex, TestSignal, TestUnit};
use crate::fields::{Codes, of_pulse};
use crate::spanned::span;
use crate::value::{Dimension, Measure, Number, Value, combine, literal};

/// A number: the same all the time, or one that changes.
#[derive(Clone, Debug)]
pub(super) enum Quantity {
    /// A constant.
    Constant(Number),
    /// Something of devices.
    Term(Term, Sort),
}

/// Reads quantities, and collects the signals that they are about.
pub(super) struct Quantities<'a> {
    pub(super) scope: Scope<'a>,
    pub(super) signals: Vec<TestSignal>,
    pub(super) diagnostics: &'a mut Vec<Diagnostic>,
}

impl<'a> Quantities<'a> {
    pub(super) fn span(&self, node: &Condition) -> Span {
        span(self.scope.file, node.range())
    }

    /// The term of a signal, which gets a number when it is named first.
    pub(super) fn signal(&mut self, signal: TestSignal) -> Term {
        let place = self.signals.iter().position(|one| *one == signal);
        Term::Signal(place.unwrap_or_else(|| {
            self.signals.push(signal);
            self.signals.len() - 1
        }))
    }

    pub(super) fn quantity(&mut self, node: &Condition) -> Option<Quantity> {
        match node {
            Condition::Number(number) => literal(number).number().copied().map(Quantity::Constant),
            Condition::Name(name) => self.named(&name.name()?),
            Condition::Index(index) => self.element(index),
            Condition::Member(member) => self.member(member),
            Condition::Call(call) => self.call(call),
            Condition::Paren(paren) => self.quantity(&paren.condition()?),
            Condition::Signed(signed) => {
                let inner = self.quantity(&signed.condition()?)?;
                Some(if signed.is_negative() { negative(inner) } else { inner })
            }
            Condition::Operation(operation) => self.operation(operation),
            Condition::Logic(_)
            | Condition::Not(_)
            | Condition::Compare(_)
            | Condition::Inside(_) => {
                let at = self.span(node);
                self.diagnostics.push(e0256_not_a_condition::condition(at));
                None
            }
        }
    }

    /// A device, a constant, `true` or `false`.
    fn named(&mut self, name: &ast::Name) -> Option<Quantity> {
        let (text, at) = (name.text(), span(self.scope.file, name.range()));
        if let Some((index, device)) = self.scope.device(text) {
            if self.scope.is_controller(index) {
                self.diagnostics.push(unknown::controller(at, text));
                return None;
            }
            let count = device.value.value.count();
            if device.value.value.length.is_some() {
                self.diagnostics.push(unknown::whole_array(at, text, count));
                return None;
            }
            return Some(self.value(index, device, None));
        }
        match self.scope.constants.get(text) {
            Some(Value::Number(number)) => return Some(Quantity::Constant(*number)),
            Some(Value::Unknown) => return None,
            Some(_) => {
                let (message, help) = ("this constant is not a number", "name one that is");
                self.diagnostics.push(wrong::not_computed(at, message, help));
                return None;
            }
            None => {}
        }
        if let "true" | "false" = text {
            let value = f64::from(u8::from(text == "true"));
            return Some(Quantity::Constant(Number::of(value, Measure::Bare)));
        }
        self.diagnostics.extend(self.scope.unknown(at, text));
        None
    }

    fn value(&mut self, index: DeviceIndex, device: &Device, element: Option<usize>) -> Quantity {
        let term = self.signal(names::value(index, device, element));
        Quantity::Term(term, names::sort(index, device))
    }

    /// The device of a name that must be one.
    pub(super) fn device(&mut self, name: &ast::Name) -> Option<(DeviceIndex, &'a Device)> {
        let at = span(self.scope.file, name.range());
        let found = self.scope.device(name.text());
        if found.is_none() {
            self.diagnostics.extend(self.scope.unknown(at, name.text()));
        }
        found
    }

    /// `Line[3]`
    fn element(&mut self, node: &ast::Index) -> Option<Quantity> {
        let name = node.name()?;
        let (index, device) = self.device(&name)?;
        let (text, at) = (name.text(), span(self.scope.file, node.range()));
        if device.value.value.length.is_none() {
            self.diagnostics.push(unknown::not_an_array(at, text));
            return None;
        }
        let written = node.index()?;
        let place = self.span(&written);
        let number = match self.quantity(&written)? {
            Quantity::Constant(Number { integer: Some(number), .. }) => number,
            Quantity::Constant(_) | Quantity::Term(..) => {
                self.diagnostics.push(unknown::no_index(place, text));
                return None;
            }
        };
        let count = device.value.value.count();
        match usize::try_from(number).ok().filter(|element| *element < count) {
            Some(element) => Some(self.value(index, device, Some(element))),
            None => {
                let report = unknown::no_element(place, text, &number.to_string(), count);
                self.diagnostics.push(report);
                None
            }
        }
    }

    /// `Follow.overruns`
    fn member(&mut self, node: &ast::Member) -> Option<Quantity> {
        let (name, word) = (node.name()?, node.word()?);
        let (index, device) = self.device(&name)?;
        let is_controller = self.scope.is_controller(index);
        if !is_controller || word.text() != "overruns" {
            let at = span(self.scope.file, word.range());
            let report = unknown::unknown_word(at, name.text(), word.text(), is_controller);
            self.diagnostics.push(report);
            return None;
        }
        let term = self.signal(names::overruns(index, device));
        Some(Quantity::Term(term, Sort::plain()))
    }

    fn call(&mut self, node: &ast::Call) -> Option<Quantity> {
        let name = node.name()?;
        let at = span(self.scope.file, node.range());
        let all: Vec<Condition> = node.arguments().collect();
        match (name.text(), all.as_slice()) {
            ("abs", [one]) => match self.quantity(one)? {
                Quantity::Constant(number) => {
                    let integer = number.integer.map(i128::abs);
                    Some(Quantity::Constant(Number {
                        value: number.value.abs(),
                        integer,
                        ..number
                    }))
                }
                Quantity::Term(term, sort) => {
                    Some(Quantity::Term(Term::Absolute(Box::new(term)), sort))
                }
            },
            ("min" | "max", [one]) => self.of_elements(one, name.text() == "min"),
            ("min" | "max", [first, rest @ ..]) => {
                let mut so_far = self.quantity(first)?;
                for one in rest {
                    let (other, at) = (self.quantity(one)?, self.span(one));
                    so_far = self.extreme((so_far, other), name.text() == "min", at)?;
                }
                Some(so_far)
            }
            ("age", [Condition::Name(of)]) => {
                let of = of.name()?;
                let (index, device) = self.device(&of)?;
                let Some((signal, sort)) = names::age(index, device) else {
                    let at = span(self.scope.file, of.range());
                    self.diagnostics.push(unknown::no_age(at, of.text()));
                    return None;
                };
                Some(Quantity::Term(self.signal(signal), sort))
            }
            (name, _) => {
                self.wrong_call(name, at, span(self.scope.file, node.name()?.range()));
                None
            }
        }
    }

    /// Reports a call that is not a quantity.
    fn wrong_call(&mut self, name: &str, at: Span, at_name: Span) {
        let report = match name {
            "abs" => unknown::arguments(at, name, "one number", "abs(Error) < 5"),
            "min" | "max" => {
                let takes = "several numbers, or an array";
                unknown::arguments(at, name, takes, &format!("{name}(Line) > 10"))
            }
            "age" => unknown::arguments(at, name, "the name of a sensor", "age(Front) < 100 ms"),
            "health" => wrong::state(at),
            "rising" | "falling" => e0256_not_a_condition::condition(at),
            _ => {
                unknown::unknown_function(at_name, name, nearest(name, FUNCTIONS.map(|one| one.0)))
            }
        };
        self.diagnostics.push(report);
    }

    /// The smallest or greatest element of an array.
    fn of_elements(&mut self, node: &Condition, is_least: bool) -> Option<Quantity> {
        let Condition::Name(name) = node else { return self.quantity(node) };
        let name = name.name()?;
        let Some((index, device)) = self.scope.device(name.text()) else {
            return self.named(&name);
        };
        if device.value.value.length.is_none() {
            return self.named(&name);
        }
        let mut all: Option<Term> = None;
        for element in 0..device.value.value.count() {
            let one = self.signal(names::value(index, device, Some(element)));
            all = Some(match all {
                Some(before) => extreme(before, one, is_least),
                None => one,
            });
        }
        Some(Quantity::Term(all?, Sort { device: None, ..names::sort(index, device) }))
    }

    fn extreme(
        &mut self,
        (one, other): (Quantity, Quantity),
        is_least: bool,
        at: Span,
    ) -> Option<Quantity> {
        let (one, other, sort) = self.alike((one, other), "compared", at)?;
        Some(Quantity::Term(extreme(one, other, is_least), sort))
    }

    fn operation(&mut self, node: &ast::Operation) -> Option<Quantity> {
        let (left, right) = (self.quantity(&node.left()?), self.quantity(&node.right()?));
        let (left, right, operator) = (left?, right?, node.operator()?);
        let at = span(self.scope.file, node.range());
        if let (Quantity::Constant(one), Quantity::Constant(other)) = (&left, &right) {
            return match combine(*one, operator, *other) {
                Ok(number) => Some(Quantity::Constant(number)),
                Err((message, help)) => {
                    self.diagnostics.push(wrong::not_computed(at, &message, help));
                    None
                }
            };
        }
        if let Operator::Add | Operator::Subtract = operator {
            let (one, other, sort) = self.alike((left, right), "added", at)?;
            let (one, other) = (Box::new(one), Box::new(other));
            let is_sum = operator == Operator::Add;
            let term = if is_sum { Term::Sum(one, other) } else { Term::Difference(one, other) };
            return Some(Quantity::Term(term, Sort { device: None, is_truth: false, ..sort }));
        }
        let ((one, first), (other, second)) = (self.factor(left, at)?, self.factor(right, at)?);
        let is_product = operator == Operator::Multiply;
        let Some(sort) = first.combined(&second, is_product) else {
            let (one, other) = (first.words(), second.words());
            let verb = if is_product { "multiplied" } else { "divided" };
            let help = "give both a unit that the language has, or none";
            self.diagnostics.push(wrong::mixed(at, verb, &one, &other, help));
            return None;
        };
        let (one, other) = (Box::new(one), Box::new(other));
        let term = if is_product { Term::Product(one, other) } else { Term::Quotient(one, other) };
        Some(Quantity::Term(term, sort))
    }

    /// A side of a product: a constant has the unit that it is written with.
    fn factor(&mut self, of: Quantity, at: Span) -> Option<(Term, Sort)> {
        match of {
            Quantity::Term(term, sort) => Some((term, sort)),
            Quantity::Constant(number) if number.dimension() == Dimension::RAW => {
                let help = "compute with the number that is shown";
                self.diagnostics.push(wrong::not_computed(
                    at,
                    "codes cannot be computed with",
                    help,
                ));
                None
            }
            Quantity::Constant(number) if number.measure == Measure::Bare => {
                Some((Term::Number(number.value), Sort::plain()))
            }
            Quantity::Constant(number) => {
                let unit = TestUnit { name: Some(number.unit_name()), ..TestUnit::default() };
                let sort = Sort::of(Some(number.dimension()), unit);
                Some((Term::Number(number.in_base_units()), sort))
            }
        }
    }

    /// Two quantities that measure the same, as terms.
    pub(super) fn alike(
        &mut self,
        sides: (Quantity, Quantity),
        verb: &str,
        at: Span,
    ) -> Option<(Term, Term, Sort)> {
        match sides {
            (Quantity::Term(one, sort), Quantity::Term(other, second)) => {
                if sort.is_like(&second) {
                    return Some((one, other, sort));
                }
                let help = "compute with values that measure the same; `quantity` of a device says what it measures";
                let (one, other) = (sort.words(), second.words());
                self.diagnostics.push(wrong::mixed(at, verb, &one, &other, help));
                None
            }
            (Quantity::Term(one, sort), Quantity::Constant(number)) => {
                Some((one, Term::Number(self.number(number, &sort, at)?), sort))
            }
            (Quantity::Constant(number), Quantity::Term(other, sort)) => {
                Some((Term::Number(self.number(number, &sort, at)?), other, sort))
            }
            (Quantity::Constant(_), Quantity::Constant(_)) => {
                self.diagnostics.push(wrong::nothing_changes(at));
                None
            }
        }
    }

    /// A constant in the unit in which something is computed.
    pub(super) fn number(&mut self, number: Number, sort: &Sort, at: Span) -> Option<f64> {
        let device = sort.device.and_then(|index| self.scope.design.device(index));
        let found = number.unit_name();
        let (message, help) = match (number.measure, device) {
            (Measure::Bare, _) if !sort.needs_unit => {
                return Some(sort.unit.computed(number.value));
            }
            (Measure::Bare, _) => (
                "a time is compared with a plain number".to_owned(),
                "write its unit: `100 ms`".to_owned(),
            ),
            (Measure::Raw, Some(device)) => {
                return Some(sort.unit.computed(device.shown.of_raw(number.value)));
            }
            (Measure::Raw, None) => {
                let message = "a code is compared with something computed".to_owned();
                (message, "write the number that is shown".to_owned())
            }
            _ if Some(number.dimension()) == sort.dimension => {
                return Some(crate::design::rounded(number.in_base_units()));
            }
            _ => match self.of_pulses(number, sort) {
                Some(Ok(percent)) => return Some(percent),
                Some(Err(why)) => why,
                None => match &sort.unit.name {
                    Some(unit) => (
                        format!("the value is in {unit}, and this is a number of {found}"),
                        format!("write it in {unit}, or without a unit"),
                    ),
                    None => (
                        format!("the value has no unit, and this is a number of {found}"),
                        "write the number alone, or give the device its `quantity`".to_owned(),
                    ),
                },
            },
        };
        self.diagnostics.push(wrong::misfit(at, &message, &help));
        None
    }

    /// The percentage of a pulse width, for an output of pulses.
    fn of_pulses(&self, number: Number, sort: &Sort) -> Option<Result<f64, (String, String)>> {
        let pulses_us = sort.pulses_us?;
        let codes = Codes { range: None, is_whole: false, pulses_us: Some(pulses_us) };
        Some(match of_pulse(&number, codes) {
            Ok(code) => Ok(sort.unit.computed(code)),
            Err(why) => Err((why.0, why.1)),
        })
    }
}

fn negative(of: Quantity) -> Quantity {
    match of {
        Quantity::Constant(number) => {
            let integer = number.integer.and_then(i128::checked_neg);
            Quantity::Constant(Number { value: -number.value, integer, ..number })
        }
        Quantity::Term(term, sort) => {
            Quantity::Term(Term::Negative(Box::new(term)), Sort { device: None, ..sort })
        }
    }
}

fn extreme(one: Term, other: Term, is_least: bool) -> Term {
    let (one, other) = (Box::new(one), Box::new(other));
    if is_least { Term::Least(one, other) } else { Term::Greatest(one, other) }
}
