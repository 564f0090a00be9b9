//! Which signals have edges that a rule asks for: rules in, numbers of signals out.

use std::collections::BTreeSet;

use sensedsl_model::design::Test;
use sensedsl_rules::{Formula, Shape};

/// The signals of which a rule asks when something rises.
pub(super) fn signals(test: &Test) -> BTreeSet<usize> {
    let mut all = BTreeSet::new();
    for rule in &test.rules {
        match &rule.rule.shape {
            Shape::Always(one) | Shape::Never(one) | Shape::Eventually(one, _) => of(one, &mut all),
            Shape::When(condition, then, _) => {
                of(condition, &mut all);
                of(then, &mut all);
            }
        }
    }
    all
}

fn of(formula: &Formula, all: &mut BTreeSet<usize>) {
    match formula {
        Formula::Compare(..) => {}
        Formula::Rising(one) => one.for_each_signal(&mut |number| {
            all.insert(number);
        }),
        Formula::Not(one) | Formula::Always(_, _, one) | Formula::Eventually(_, _, one) => {
            of(one, all);
        }
        Formula::And(one, other) | Formula::Or(one, other) | Formula::Implies(one, other) => {
            of(one, all);
            of(other, all);
        }
    }
}
