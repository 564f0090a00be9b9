//! What a file says of runs: blocks of tests in; [`Test`]s with devices, numbers and formulas, and what is wrong with
//! them, out.
//!
//! Tests are read last, because they are about the finished design: its devices, and the units in which hosts show them.

mod condition;
mod expression;
mod names;
mod quantity;
mod sort;
mod steps;
mod times;
pub(crate) mod words;

use sensedsl_diagnostics::codes::{e0201_unknown_property, e0255_test_without_rules};
use sensedsl_diagnostics::{Diagnostic, FileId, nearest};
use sensedsl_syntax::ast;

use crate::design::{Design, Test};
use crate::fields::Fields;
use crate::rule::names as rule_names;
use crate::spanned::{Spanned, named};
use crate::value::constants::Constants;
use names::Scope;
use times::Length;
use words::{LENGTH_MAX_US, LENGTH_MIN_US, PROPERTIES};

pub use expression::{Expression, Like, expression, unit_of_device};

/// Reads the tests of a design, each in its file. Names of devices that could not be read are `absent`: their mistakes
/// were told already.
pub(crate) fn read(
    design: &Design,
    tests: &[(FileId, ast::Test)],
    absent: &[Spanned<String>],
    (constants, diagnostics): (&Constants, &mut Vec<Diagnostic>),
) -> Vec<Test> {
    let names: Vec<Spanned<String>> =
        tests.iter().filter_map(|(file, node)| Some(named(*file, &node.name()?))).collect();
    rule_names::check("test", &names.iter().collect::<Vec<_>>(), diagnostics);
    let mut all = Vec::new();
    for (file, node) in tests {
        let scope = Scope { file: *file, design, absent, constants };
        all.extend(one(scope, node, diagnostics));
    }
    all
}

fn one(scope: Scope<'_>, node: &ast::Test, diagnostics: &mut Vec<Diagnostic>) -> Option<Test> {
    let name = named(scope.file, &node.name()?);
    let owner = format!("the test `{}`", name.value);
    let reported = (scope.constants, &mut *diagnostics);
    let mut fields = Fields::new(node.properties(), scope.file, &owner, name.span, reported);
    let world = fields.text("world");
    let lasts = fields.time_us("for", LENGTH_MIN_US..=LENGTH_MAX_US);
    let seed = fields.integer("seed", 0..=i64::MAX).and_then(|seed| u64::try_from(seed.value).ok());
    let has_length = lasts.is_some() || node.properties().any(|one| is_length(&one));
    if !has_length {
        fields.missing("for", "for = 10 s;");
    }
    for field in fields.rest() {
        let meant = nearest(&field.name, PROPERTIES.iter().copied());
        let report = e0201_unknown_property::unknown_property;
        fields.say(report(field.name_span, &field.name, "a test", meant));
    }
    let length = lasts.map(|lasts| Length { ns: u64::from(lasts.value) * 1_000, span: lasts.span });
    let mut reader = steps::Reader::new(scope, length, diagnostics);
    for step in node.steps() {
        reader.step(&step);
    }
    let has_rules =
        node.steps().any(|step| !matches!(step, ast::Step::Set(_) | ast::Step::Fault(_)));
    let read = reader.finish();
    if !has_rules {
        diagnostics.push(e0255_test_without_rules::without_rules(name.span, &name.value));
    }
    let steps::Steps { sets, faults, signals, rules } = read;
    Some(Test { name, world, seed, lasts_ns: length?.ns, sets, faults, signals, rules })
}

fn is_length(property: &ast::Property) -> bool {
    property.name().is_some_and(|name| name.text() == "for")
}

#[cfg(test)]
mod tests;
