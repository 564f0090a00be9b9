//! H0710: a motor that keeps going when the host falls silent.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "H0710",
    title: "a motor goes on when the host falls silent",
    explanation: r#"An actuator without `failsafe` keeps its last value when the host has crashed or its cable is pulled. With a motor
behind a bridge that is a robot which drives on. The motors of the library have `failsafe = 0;`.

Way out: say what it must do then, in the driver's command or in the actuator: `failsafe = 0;` stops it. If it must go on,
write `allow H0710 "reason";`."#,
});

/// An actuator that drives a motor and has no `failsafe`; `block` is it.
pub fn motor_goes_on(span: Span, name: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("{name} keeps its last speed when the host falls silent"))
        .here("a motor without `failsafe`")
        .help("write `failsafe = 0;` here or in the command of its driver: then it stops")
        .add(span, "failsafe = 0;")
}
