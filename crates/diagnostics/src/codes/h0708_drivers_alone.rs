//! H0708: a file has drivers and nothing else.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "H0708",
    title: "drivers without a board",
    explanation: r#"The file has drivers, and neither a board nor a device. All its drivers have been checked, but there is nothing to wire,
to simulate or to generate.

Way out: none is needed. A design takes the file in with `use "FILE";`; `sensedsl drivers --new NAME` prints a board to
try a driver on."#,
});

/// `count` is the number of drivers; the place is the first one's name.
pub fn drivers_alone(span: Span, count: usize) -> Diagnostic {
    let drivers = if count == 1 { "1 driver".to_owned() } else { format!("{count} drivers") };
    let message = format!("the file has {drivers} and no board, so there is nothing to wire");
    Diagnostic::new(CODE, span, &message).help(
        "a design takes it in with `use \"FILE\";`; `sensedsl drivers --new NAME` prints a board to try a driver on",
    )
}
