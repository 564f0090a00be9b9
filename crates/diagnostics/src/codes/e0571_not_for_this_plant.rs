//! E0571: a device does not fit what a plant does with it.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0571",
    title: "a device that does not fit a plant",
    explanation: r#"A plant is driven by actuators and measured by sensors, and what it gives has a unit: a heater gives degC, a ranger a
length, an encoder turns. The sensor must show a unit of that sort, or the world must say how its numbers come about:

- a sensor that shows no unit needs two points: `{ sensor = "Pot", points = [["-90 deg", 300], ["90 deg", 3700]] }`;
- an encoder needs its counts of a turn: `counts` of the device, or `{ sensor = "Wheel", counts = 1400 }`;
- an array is measured by its places, `Joints[2]`, unless the plant measures all of its elements;
- an actuator whose greatest value is not known needs it: `full = 255` is the value at full drive;
- a stepper motor is moved by its own steps, not by a plant.

Way out: name another device, or give the table that the message asks for."#,
});

/// `why` is a sentence without its end, `help` says what to write.
pub fn does_not_fit(span: Span, why: &str, help: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, why.to_owned()).here("this device").help(help)
}
