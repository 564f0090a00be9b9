//! E0311: the board has no such peripheral.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0311",
    title: "the board has no such peripheral",
    explanation: r#"`unit` names a peripheral instance such as ADC1, I2C2 or TIM3 that the board's table has and that
this kind of device can use.

Way out: use one of the units that the message lists."#,
});

/// `units` are the units that exist for this kind.
pub fn unknown_unit(span: Span, unit: &str, kind: &str, units: &[String]) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{unit}` cannot serve {kind}"))
        .help(if units.is_empty() {
            format!("the board has nothing for {kind}")
        } else {
            format!("use one of {}", units.join(", "))
        })
        .one_of(units.iter().map(String::as_str))
}
