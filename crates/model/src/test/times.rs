//! Times of a test: an expression in, nanoseconds from the beginning of the run out.

use sensedsl_diagnostics::codes::e0254_time_of_test as wrong;
use sensedsl_diagnostics::{Diagnostic, Span};
use sensedsl_syntax::ast::{self, AstNode as _};

use super::names::Scope;
use crate::spanned::{Spanned, span};
use crate::value::{Dimension, Evaluator, Value};

/// How long a test runs, and where that is written.
#[derive(Clone, Copy, Debug)]
pub(super) struct Length {
    pub(super) ns: u64,
    pub(super) span: Span,
}

/// A time, which must lie within the test.
pub(super) fn time(
    scope: Scope<'_>,
    node: &ast::Value,
    length: Option<Length>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<Spanned<u64>> {
    let at = span(scope.file, node.range());
    let value = Evaluator::new(scope.file, scope.constants, diagnostics).value(node);
    let found = match value {
        Value::Unknown => return None,
        Value::Number(number) if number.dimension() == Dimension::TIME => {
            let ns = number.in_base_units() * 1e9;
            if ns >= 0.0 {
                #[expect(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "not negative; what is too long saturates, and is refused below"
                )]
                let ns = ns.round() as u64;
                return within(Spanned { value: ns, span: at }, length, diagnostics);
            }
            "a time before the beginning".to_owned()
        }
        Value::Number(number) => match number.unit_name().as_str() {
            "no unit" => format!("the number {}", number.value),
            unit => format!("a number of {unit}"),
        },
        Value::Name(name) => format!("the word `{name}`"),
        Value::Text(_) | Value::List(_) | Value::Range(_) => "something else".to_owned(),
    };
    diagnostics.push(wrong::not_a_time(at, &found));
    None
}

fn within(
    time: Spanned<u64>,
    length: Option<Length>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<Spanned<u64>> {
    if let Some(length) = length.filter(|length| time.value > length.ns) {
        let (time_shown, end) = (shown(time.value), shown(length.ns));
        diagnostics.push(wrong::after_end(time.span, &time_shown, &end, length.span));
        return None;
    }
    Some(time)
}

/// Nanoseconds as people write times.
pub(super) fn shown(ns: u64) -> String {
    let (whole, part, unit) = if ns >= 1_000_000_000 {
        (ns / 1_000_000_000, ns % 1_000_000_000 / 1_000, "s")
    } else {
        (ns / 1_000_000, ns % 1_000_000, "ms")
    };
    let text = format!("{whole}.{part:06}");
    format!("{} {unit}", text.trim_end_matches('0').trim_end_matches('.'))
}
