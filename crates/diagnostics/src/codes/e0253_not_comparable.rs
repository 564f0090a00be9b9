//! E0253: a condition of a test computes or compares what does not go together.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0253",
    title: "these two cannot be compared",
    explanation: r#"Conditions of tests compare values as hosts show them. Both sides measure the same: `Front < 20 cm` where `Front`
shows cm, mm or m; `Front < Rear` where both show lengths. A number without a unit is in the unit that the device
shows. A device without a `quantity` has no unit, so it is compared with plain numbers, and with devices that have
none either. A `pwm` output without a `quantity` is compared with percentages, pulse widths, and codes from 0 to
10000.

Way out: write the number in a unit of the device, or give the device its `quantity`."#,
});

/// What is measured differs. `one` and `other` say what each is, `help` what to write.
pub fn mixed(span: Span, verb: &str, one: &str, other: &str, help: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("{one} and {other} cannot be {verb}"))
        .here("these two").help(help)
}

/// A number whose unit does not fit the value that it is compared with.
pub fn misfit(span: Span, message: &str, help: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, message).here("this number").help(help)
}

/// A condition without a device.
pub fn nothing_changes(span: Span) -> Diagnostic {
    Diagnostic::new(CODE, span, "no device is in this comparison, so it never changes")
        .help("compare a device: `Front < 20 cm`")
}

/// A result that is not a number that can be used.
pub fn not_computed(span: Span, message: &str, help: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, message).help(help)
}

/// A state that is compared with something that it is not.
pub fn state(span: Span) -> Diagnostic {
    Diagnostic::new(CODE, span, "a state is equal to another one, or it is not")
        .help("compare it with `==` or `!=`: `health(Front) == good`")
}

/// A range whose first end is above its last one.
pub fn reversed(span: Span) -> Diagnostic {
    Diagnostic::new(CODE, span, "the range ends below its beginning, so nothing is in it")
        .help("write the smaller end first: `0 % .. 100 %`")
}
