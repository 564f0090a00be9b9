//! Conditions: what is written in, a formula over numbered signals out.

use sensedsl_diagnostics::Diagnostic;
use sensedsl_diagnostics::codes::{
    e0252_unknown_in_test as unknown, e0253_not_comparable as wrong, e0256_not_a_condition,
};
use sensedsl_rules::{Compare, Formula, Term};
use sensedsl_syntax::ast::{self, AstNode as _, Comparison, Condition};

use super::names::{self, Scope};
use super::quantity::{Quantities, Quantity};
use super::sort::Sort;
use super::words::STATES;
use crate::design::{TestSignal, TestUnit};
use crate::spanned::span;
use crate::value::{Evaluator, Number, Value};

/// Reads the conditions of a test.
pub(super) struct Conditions<'a> {
    quantities: Quantities<'a>,
    /// The units of what was compared in this rule; none for what has no distance.
    margins: Vec<Option<TestUnit>>,
}

impl<'a> Conditions<'a> {
    pub(super) fn new(scope: Scope<'a>, diagnostics: &'a mut Vec<Diagnostic>) -> Self {
        let quantities = Quantities { scope, signals: Vec::new(), diagnostics };
        Self { quantities, margins: Vec::new() }
    }

    /// What names mean.
    pub(super) fn scope(&self) -> Scope<'a> {
        self.quantities.scope
    }

    /// Where mistakes are told.
    pub(super) fn diagnostics(&mut self) -> &mut Vec<Diagnostic> {
        self.quantities.diagnostics
    }

    /// The signals of all conditions.
    pub(super) fn signals(self) -> Vec<TestSignal> {
        self.quantities.signals
    }

    /// The unit of the distances in the conditions since the last call; none if there is not one for all of them.
    pub(super) fn margin(&mut self) -> Option<TestUnit> {
        let all = std::mem::take(&mut self.margins);
        let first = all.first()?.clone()?;
        let is_alike = |one: &Option<TestUnit>| {
            let one = one.as_ref();
            one.is_some_and(|one| one.name == first.name && one.power == first.power)
        };
        all.iter().all(is_alike).then_some(first)
    }

    pub(super) fn condition(&mut self, node: &Condition) -> Option<Formula> {
        match node {
            Condition::Logic(logic) => {
                let one = self.condition(&logic.left()?);
                let other = self.condition(&logic.right()?);
                let (one, other) = (Box::new(one?), Box::new(other?));
                let is_and = logic.is_and();
                Some(if is_and { Formula::And(one, other) } else { Formula::Or(one, other) })
            }
            Condition::Not(not) => Some(Formula::Not(Box::new(self.condition(&not.condition()?)?))),
            Condition::Paren(paren) => self.condition(&paren.condition()?),
            Condition::Compare(compare) => self.compare(compare),
            Condition::Inside(inside) => self.inside(inside),
            Condition::Call(call) if is_called(call, &["rising", "falling"]) => self.edge(call),
            Condition::Call(_)
            | Condition::Operation(_)
            | Condition::Signed(_)
            | Condition::Number(_)
            | Condition::Name(_)
            | Condition::Index(_)
            | Condition::Member(_) => self.truth(node),
        }
    }

    /// Something that is itself true or false.
    fn truth(&mut self, node: &Condition) -> Option<Formula> {
        match self.quantities.quantity(node)? {
            Quantity::Term(term, sort) if sort.is_truth => {
                self.margins.push(None);
                Some(Formula::Compare(term, Compare::Unequal, Term::Number(0.0)))
            }
            Quantity::Term(..) | Quantity::Constant(_) => {
                let at = self.quantities.span(node);
                self.diagnostics().push(e0256_not_a_condition::quantity(at));
                None
            }
        }
    }

    /// `rising(CONDITION)`, `falling(CONDITION)`
    fn edge(&mut self, call: &ast::Call) -> Option<Formula> {
        let is_rising = is_called(call, &["rising"]);
        let all: Vec<Condition> = call.arguments().collect();
        let [one] = all.as_slice() else {
            let at = span(self.scope().file, call.range());
            let name = if is_rising { "rising" } else { "falling" };
            let example = format!("{name}(Front < 20 cm)");
            let report = unknown::arguments(at, name, "one condition", &example);
            self.diagnostics().push(report);
            return None;
        };
        let one = self.condition(one)?;
        let one = if is_rising { one } else { Formula::Not(Box::new(one)) };
        Some(Formula::Rising(Box::new(one)))
    }

    fn compare(&mut self, node: &ast::Compare) -> Option<Formula> {
        let (left, right, how) = (node.left()?, node.right()?, node.comparison()?);
        let how = match how {
            Comparison::Less => Compare::Less,
            Comparison::AtMost => Compare::AtMost,
            Comparison::Greater => Compare::Greater,
            Comparison::AtLeast => Compare::AtLeast,
            Comparison::Equal => Compare::Equal,
            Comparison::Unequal => Compare::Unequal,
        };
        let states = [(&left, &right), (&right, &left)];
        for (one, other) in states {
            if let Condition::Call(call) = one
                && is_called(call, &["health"])
            {
                return self.state(call, how, other);
            }
        }
        let one = self.quantities.quantity(&left);
        let other = self.quantities.quantity(&right);
        let at = span(self.scope().file, node.range());
        let (one, other, sort) = self.quantities.alike((one?, other?), "compared", at)?;
        let has_distance = !matches!(how, Compare::Equal | Compare::Unequal) && !sort.is_truth;
        self.margins.push(has_distance.then_some(sort.unit));
        Some(Formula::Compare(one, how, other))
    }

    /// `health(DEVICE) == STATE`
    fn state(&mut self, call: &ast::Call, how: Compare, other: &Condition) -> Option<Formula> {
        let all: Vec<Condition> = call.arguments().collect();
        let at = span(self.scope().file, call.range());
        let [Condition::Name(device)] = all.as_slice() else {
            let (takes, example) = ("the name of a device", "health(Front) == good");
            self.diagnostics().push(unknown::arguments(at, "health", takes, example));
            return None;
        };
        if !matches!(how, Compare::Equal | Compare::Unequal) {
            self.diagnostics().push(wrong::state(at));
            return None;
        }
        let word = if let Condition::Name(name) = other { name.name() } else { None };
        let word = word.map(|name| name.text().to_owned());
        let found = STATES.iter().find(|(name, _)| word.as_deref() == Some(*name));
        let Some((_, status)) = found else {
            let list: Vec<&str> = STATES.iter().map(|(name, _)| *name).collect();
            let at = self.quantities.span(other);
            self.diagnostics().push(unknown::unknown_state(at, &list.join(", ")));
            return None;
        };
        let (index, device) = self.quantities.device(&device.name()?)?;
        let term = self.quantities.signal(names::health(index, device));
        self.margins.push(None);
        Some(Formula::Compare(term, how, Term::Number(f64::from(status.code()))))
    }

    /// `VALUE in FIRST .. LAST`
    fn inside(&mut self, node: &ast::Inside) -> Option<Formula> {
        let value = self.quantities.quantity(&node.value()?);
        let range = node.range_of()?;
        let at = span(self.scope().file, range.range());
        let ends = [range.first()?, range.last()?];
        let [first, last] = [self.end(&ends[0]), self.end(&ends[1])];
        let (value, first, last) = (value?, first?, last?);
        let Quantity::Term(term, sort) = value else {
            self.diagnostics().push(wrong::nothing_changes(at));
            return None;
        };
        let first = self.quantities.number(first, &sort, at)?;
        let last = self.quantities.number(last, &sort, at)?;
        if first > last {
            self.diagnostics().push(wrong::reversed(at));
            return None;
        }
        self.margins.push(self.distance(&sort));
        let above = Formula::Compare(term.clone(), Compare::AtLeast, Term::Number(first));
        let below = Formula::Compare(term, Compare::AtMost, Term::Number(last));
        Some(Formula::And(Box::new(above), Box::new(below)))
    }

    fn distance(&self, sort: &Sort) -> Option<TestUnit> {
        (!sort.is_truth).then(|| sort.unit.clone())
    }

    /// An end of a range: a constant.
    fn end(&mut self, node: &ast::Value) -> Option<Number> {
        let scope = self.scope();
        let at = span(scope.file, node.range());
        match Evaluator::new(scope.file, scope.constants, self.diagnostics()).value(node) {
            Value::Number(number) => Some(number),
            Value::Unknown => None,
            Value::Name(_) | Value::Text(_) | Value::List(_) | Value::Range(_) => {
                let (message, help) = (
                    "an end of a range is a constant",
                    "write a number, or compare twice: `Left >= Low and Left <= High`",
                );
                self.diagnostics().push(wrong::not_computed(at, message, help));
                None
            }
        }
    }
}

fn is_called(call: &ast::Call, names: &[&str]) -> bool {
    call.name().is_some_and(|name| names.contains(&name.text()))
}
