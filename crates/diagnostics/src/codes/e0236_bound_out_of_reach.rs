//! E0236: a bound that the value never reaches.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0236",
    title: "a bound that the value cannot reach",
    explanation: r#"`min` and `max` bound the shown value, after `scale`, `offset` and `curve`. What the type holds and what the
part gives or takes end before this bound, so one of the lines is wrong: mostly `scale` is missing,
or the bound is in another unit than the one that is shown.

Way out: write the bound in the unit that is shown, within the range that the message names; give
`scale`; or take a wider type."#,
});

/// `bound` is the value of the property, `range` the range of the device.
pub fn bound_out_of_reach(
    span: Span,
    (property, bound): (&str, &str),
    device: &str,
    range: &str,
    help: &str,
) -> Diagnostic {
    let message = format!("`{property}` of {device} is {bound}, but its value goes from {range}");
    Diagnostic::new(CODE, span, message).here("out of reach").help(help)
}
