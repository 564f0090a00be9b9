//! E0106: not a number.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0106",
    title: "not a number",
    explanation: r#"Numbers are decimal (`60`, `0.5`, `1.5e-3`), hexadecimal (`0xE6`) or binary (`0b1010`), with `_`
between digits where it helps, and integers fit in 64 bits. A unit may follow: `us ms s Hz kHz MHz mV V Ohm kOhm`,
and of shown values `% mm cm m deg degC mA A W rpm deg/s mm/s cm/s m/s m/s^2`.

Way out: write it in one of these forms."#,
});

/// `text` is the number as written, `why` what is wrong with it.
pub fn bad_number(span: Span, text: &str, why: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{text}` is not a number: {why}"))
        .help("write it like 60, 0.5, 0xE6 or 0b1010, with a unit such as ms or kHz where one is meant")
}

/// A unit after something that is not a number, such as a name.
pub fn unit_alone(span: Span, unit: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("the unit `{unit}` does not follow a number"))
        .here("only a number has a unit")
        .help(format!("remove it where the value has its unit already; otherwise multiply by `1 {unit}`"))
}

/// No type holds it.
pub fn too_large(span: Span, number: &str) -> Diagnostic {
    bad_number(span, number, "it is too large")
}
