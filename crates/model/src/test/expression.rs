//! Arithmetic over the values of devices, in a text that is not a design: what is written in a world in, a term with the
//! signals that it is about out.

use sensedsl_diagnostics::codes::{e0253_not_comparable as wrong, e0256_not_a_condition};
use sensedsl_diagnostics::{Diagnostic, FileId, Span};
use sensedsl_rules::Term;
use sensedsl_syntax::ast::{AstNode as _, Condition, FileItem, SourceFile, Step};

use super::names::{self, Scope};
use super::quantity::{Quantities, Quantity};
use super::sort::Sort;
use crate::design::{Design, Device, DeviceIndex, TestSignal, TestUnit};
use crate::source::syntax_errors;
use crate::spanned::span;
use crate::value::Measure;
use crate::value::constants::Constants;

/// A number at each moment, made of the values of devices.
#[derive(Clone, Debug, PartialEq)]
pub struct Expression {
    /// The number, in the units in which conditions of tests are computed.
    pub term: Term,
    /// What its signals are, by number.
    pub signals: Vec<TestSignal>,
    /// The unit in which people read it.
    pub unit: TestUnit,
    sort: Sort,
}

/// What an expression must measure.
#[derive(Clone, Copy, Debug)]
pub enum Like<'a> {
    /// Anything.
    Any,
    /// The same as another one.
    Expression(&'a Expression),
    /// What a device shows.
    Device(DeviceIndex),
}

/// What stands before and behind an expression, so that it is read as in a test.
const AROUND: [&str; 2] = ["test X{always ", " == 0;}"];

/// Reads an expression that stands at `at` in a file; `None` if something is wrong with it, which is told.
pub fn expression(
    design: &Design,
    (file, at): (FileId, usize),
    text: &str,
    like: Like<'_>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<Expression> {
    let [before, behind] = AROUND;
    // Spaces in front give all places the numbers that they have in the file.
    let pad = " ".repeat(at.saturating_sub(before.len()));
    let parsed = sensedsl_syntax::parse(&format!("{pad}{before}{text}{behind}"));
    let whole = Span::new(file, at..at + text.len());
    if let Some(error) = parsed.errors().first() {
        let report = syntax_errors::diagnostic(error, file);
        let at = within(report.primary.span, whole);
        let help = "write arithmetic over values of devices: `0.5 * (Left - Right)`";
        diagnostics.push(wrong::not_computed(at, &report.message, help));
        return None;
    }
    let Some(written) = only(&parsed.ast(), whole) else {
        diagnostics.push(e0256_not_a_condition::condition(whole));
        return None;
    };
    let constants = Constants::default();
    let scope = Scope { file, design, absent: &[], constants: &constants };
    let mut quantities = Quantities { scope, signals: Vec::new(), diagnostics };
    let quantity = quantities.quantity(&written)?;
    let (term, sort) = fitted(&mut quantities, quantity, like, whole)?;
    let signals = quantities.signals;
    Some(Expression { term, signals, unit: sort.unit.clone(), sort })
}

/// The expression between what stands around it; none if it is something else, or ends what stands around it by itself.
fn only(file: &SourceFile, whole: Span) -> Option<Condition> {
    let FileItem::Test(test) = file.items().next()? else { return None };
    let Step::Always(rule) = test.steps().next()? else { return None };
    let Condition::Compare(compare) = rule.condition()? else { return None };
    let behind = span(whole.file, compare.right()?.range());
    (behind.start >= whole.end).then(|| compare.left()).flatten()
}

/// A place in an expression; what lies around it is nobody's.
fn within(span: Span, whole: Span) -> Span {
    let clamped = |end: u32| end.clamp(whole.start, whole.end);
    Span { start: clamped(span.start), end: clamped(span.end), ..span }
}

/// The quantity as what it must measure.
fn fitted(
    quantities: &mut Quantities<'_>,
    quantity: Quantity,
    like: Like<'_>,
    at: Span,
) -> Option<(Term, Sort)> {
    let wanted = match like {
        Like::Any => None,
        Like::Expression(one) => Some(one.sort.clone()),
        Like::Device(index) => {
            let device = quantities.scope.design.device(index)?;
            Some(names::sort(index, device))
        }
    };
    match (quantity, wanted) {
        (Quantity::Constant(number), Some(sort)) => {
            let value = quantities.number(number, &sort, at)?;
            Some((Term::Number(value), sort))
        }
        (Quantity::Constant(number), None) if number.measure == Measure::Bare => {
            Some((Term::Number(number.value), Sort::plain()))
        }
        (Quantity::Constant(number), None) => {
            let unit = TestUnit { name: Some(number.unit_name()), ..TestUnit::default() };
            let sort = Sort::of(Some(number.dimension()), unit);
            Some((Term::Number(number.in_base_units()), sort))
        }
        (Quantity::Term(_, sort), Some(wanted)) if !sort.is_like(&wanted) => {
            let message = format!("this is {}, and {} is needed", sort.words(), wanted.words());
            let help = "multiply by a number with a unit, or divide by one";
            quantities.diagnostics.push(wrong::misfit(at, &message, help));
            None
        }
        // What it is set to is read in that one's unit.
        (Quantity::Term(term, _), Some(wanted)) => Some((term, wanted)),
        (Quantity::Term(term, sort), None) => Some((term, sort)),
    }
}

/// The unit in which people read a device's value in an expression.
#[must_use]
pub fn unit_of_device(index: DeviceIndex, device: &Device) -> TestUnit {
    names::sort(index, device).unit
}
