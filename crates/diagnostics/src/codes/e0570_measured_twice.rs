//! E0570: a world says twice what a sensor measures.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0570",
    title: "a world says twice what a sensor measures",
    explanation: r#"A sensor measures one thing: what its line under `[devices]` says, or what one plant gives it. With both, or with two
plants, there is no telling which one counts.

    [devices]
    Wheels = { rate = 400 }       # and the robot's wheels turn it, too

    [plants.Robot]
    kind = "differential_drive"
    left = "Left"
    right = "Right"
    encoders = "Wheels"

Way out: take the line under `[devices]` out, or the sensor out of the plant. Elements of an array may be shared out
among plants by their places: `Joints[0]`, `Joints[1]`."#,
});

/// `other` is what measures it, too: `a line under [devices]`, "`Robot`".
pub fn measured_twice(span: Span, sensor: &str, other: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{sensor}` is measured twice: {other} says it, too"))
        .here("the second time")
        .help("take one of the two out")
}
