//! E0214: a device of this kind cannot have that direction.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0214",
    title: "a device of this kind cannot go that way",
    explanation: r#"Some kinds only measure (analog, icu, encoder) and some only act (pwm, dac, stepper); the others do both. A
sensor `returns` a value, an actuator `accepts` one.

Way out: declare the device the other way round, or change its `type`."#,
});

/// `can` is the keyword that the kind can be used with.
pub fn wrong_direction(span: Span, kind: &str, can: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("{kind} can only be {can}"))
        .help(format!("declare the device as {can}, or change its `type`"))
}
