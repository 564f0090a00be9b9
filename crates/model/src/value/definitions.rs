//! The `const` statements of all files in, the table of their values out, each computed after those that it needs.

use std::collections::{BTreeMap, BTreeSet};

use sensedsl_diagnostics::codes::e0228_constants_in_a_circle;
use sensedsl_diagnostics::{Diagnostic, FileId};
use sensedsl_syntax::ast::{self, AstNode as _};

use super::constants::Constants;
use crate::spanned::{Spanned, span};
use crate::value::{Evaluator, Value};

/// A constant that has not been computed yet.
struct Pending {
    file: FileId,
    name: ast::Name,
    value: ast::Value,
    /// The other constants that it names.
    needs: Vec<String>,
}

/// Computes the values, each after the ones that it needs.
pub(crate) fn computed(
    all: &[(FileId, ast::Constant)],
    diagnostics: &mut Vec<Diagnostic>,
) -> Constants {
    let mut pending: BTreeMap<String, Pending> = BTreeMap::new();
    for (file, node) in all {
        let (Some(name), Some(value)) = (node.name(), node.value()) else { continue };
        let names = value.syntax().descendants().filter_map(ast::NameValue::cast);
        let needs = names.filter_map(|one| Some(one.name()?.text().to_owned())).collect();
        let key = name.text().to_owned();
        // A duplicate name is reported elsewhere; the first one counts.
        pending.entry(key).or_insert(Pending { file: *file, name, value, needs });
    }
    let mut constants = Constants::default();
    while let Some((first, _)) = pending.first_key_value() {
        let first = first.clone();
        compute(&mut constants, first, &mut pending, diagnostics);
    }
    constants
}

/// Computes one constant, after the ones that it needs. The chain may be long, so this uses a
/// stack, not recursion.
fn compute(
    constants: &mut Constants,
    first: String,
    pending: &mut BTreeMap<String, Pending>,
    diagnostics: &mut Vec<Diagnostic>,
) {
    let mut is_open = BTreeSet::from([first.clone()]);
    let mut open: Vec<String> = vec![first];
    while let Some(name) = open.last().cloned() {
        let Some(one) = pending.get_mut(&name) else {
            open.pop();
            is_open.remove(&name);
            continue;
        };
        if let Some(need) = one.needs.pop() {
            if is_open.contains(&need) {
                let circle = open.iter().skip_while(|name| **name != need);
                let mut circle: Vec<&str> = circle.map(String::as_str).collect();
                circle.push(&need);
                let at = span(one.file, one.name.range());
                let report = e0228_constants_in_a_circle::constants_in_a_circle;
                diagnostics.push(report(at, &circle.join(" -> ")));
                // Constants that need any of them are not reported again.
                is_open.clear();
                for name in open.drain(..) {
                    pending.remove(&name);
                    constants.values.insert(name, Value::Unknown);
                }
            } else if pending.contains_key(&need) {
                is_open.insert(need.clone());
                open.push(need);
            }
            continue;
        }
        let Some(one) = pending.remove(&name) else { continue };
        let mut evaluator = Evaluator::new(one.file, constants, diagnostics);
        let value = evaluator.value(&one.value);
        is_open.remove(&name);
        constants.values.insert(name, value);
        open.pop();
    }
}

/// The names of the constants, with their places.
pub(crate) fn names(all: &[(FileId, ast::Constant)]) -> Vec<Spanned<String>> {
    let name = |(file, node): &(FileId, ast::Constant)| {
        let name = node.name()?;
        Some(Spanned { value: name.text().to_owned(), span: span(*file, name.range()) })
    };
    all.iter().filter_map(name).collect()
}
