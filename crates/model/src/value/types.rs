//! The type of a value: a syntax node in, scalar and length out.

use sensedsl_diagnostics::codes::{
    e0208_unknown_type, e0211_out_of_range, e0227_cannot_compute as cannot,
};
use sensedsl_diagnostics::{Diagnostic, FileId, nearest};
use sensedsl_syntax::ast::{self, AstNode as _};
use sensedsl_wire::{ScalarType, ValueType};

use crate::fields::plain_integer;
use crate::spanned::{Spanned, span};
use crate::value::constants::Constants;
use crate::value::other_types;

/// Most elements of an array.
const ARRAY_MAX: u64 = 1_024;

/// Reads a type; mistakes in it are reported.
pub(crate) fn read(
    file: FileId,
    ty: Option<ast::Type>,
    (constants, diagnostics): (&Constants, &mut Vec<Diagnostic>),
) -> Option<Spanned<ValueType>> {
    let ty = ty?;
    let scalar = ty.scalar()?;
    let at = span(file, scalar.range());
    let Some(found) = ScalarType::from_name(scalar.text()) else {
        let meant = other_types::meant(scalar.text());
        diagnostics.push(e0208_unknown_type::unknown_type(at, scalar.text(), meant));
        return None;
    };
    let span_all = span(file, ty.range());
    if !ty.is_array() {
        return Some(Spanned { value: ValueType::scalar(found), span: span_all });
    }
    let (length, at) = match (ty.length(), ty.length_name()) {
        (Some((length, range)), _) => (i128::from(length), span(file, range)),
        (None, Some(name)) => {
            let at = span(file, name.range());
            let Some(value) = constants.get(name.text()) else {
                let meant = nearest(name.text(), constants.names());
                diagnostics.push(cannot::not_a_constant(at, name.text(), meant));
                return None;
            };
            let Some(length) = plain_integer(value) else {
                let message = format!("`{}` is not a whole number", name.text());
                let help = "the length of an array is a whole number";
                diagnostics.push(cannot::cannot_compute(at, &message, help));
                return None;
            };
            (length, at)
        }
        (None, None) => return None,
    };
    let range = 1..=i128::from(ARRAY_MAX);
    let Some(length) = u16::try_from(length).ok().filter(|n| range.contains(&i128::from(*n)))
    else {
        let range = format!("1 to {ARRAY_MAX}");
        let report = e0211_out_of_range::out_of_range;
        diagnostics.push(report(at, "array length", &length.to_string(), &range));
        return None;
    };
    Some(Spanned { value: ValueType { scalar: found, length: Some(length) }, span: span_all })
}
