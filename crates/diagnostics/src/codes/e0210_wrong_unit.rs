//! E0210: the unit does not fit.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0210",
    title: "the unit does not fit",
    explanation: r#"Times are written in us, ms or s, frequencies in Hz, kHz or MHz. A bare `delay` is milliseconds.

Way out: use a unit of the right dimension."#,
});

/// `takes` lists the units that fit, `same` is the value in one of them.
pub fn wrong_unit(span: Span, name: &str, unit: &str, takes: &str, same: Option<&str>) -> Diagnostic {
    let diagnostic = Diagnostic::new(CODE, span, format!("`{name}` cannot be given in {unit}"));
    match same {
        Some(same) => diagnostic.help(format!("use {takes}: `{same}` is the same")).one_of([same]),
        None => diagnostic.help(format!("use {takes}")),
    }
}
