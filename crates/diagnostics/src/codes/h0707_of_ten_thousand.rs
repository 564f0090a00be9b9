//! H0707: a small value of a pwm output.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "H0707",
    title: "a value of a pwm output is of 10000",
    explanation: r#"A pwm output without `quantity` goes from 0 to 10000, whatever its pulses are. A bare number up to 100 is
thus at most a hundredth of its range, which is seldom meant: people think of percent, or of degrees
of a servo.

Way out: write the unit: `50 %` is half of the range, and `1500 us` is the pulse. Where the small
number is meant, write it as a code: `raw 50`."#,
});

/// `percent` is the percentage that `number` stands for.
pub fn of_ten_thousand(span: Span, number: &str, percent: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("{number} of 10000 is {percent} % of the range"))
        .here("0 to 10000")
        .help(format!("write `{number} %` or a pulse such as `1500 us` if that is meant, or `raw {number}`"))
        .one_of([format!("{number} %").as_str(), format!("raw {number}").as_str()])
}
