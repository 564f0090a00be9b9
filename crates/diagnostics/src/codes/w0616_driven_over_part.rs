//! W0616: a board drives a part over its supply.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "W0616",
    title: "a board drives a part over its supply",
    explanation: r#"The board puts the voltage of its MCU's supply on a wire to the part, 5 V on an Arduino Uno, and the driver says
that the part's supply is lower. An input that is over the part's own supply feeds it through its protection,
which damages it sooner or later. The lines of I2C are not meant: whoever pulls them up decides their voltage.

Way out: put a level shifter, or two resistors, between board and part, or take a board of the part's voltage. Where
the module has level shifters, say so: `allow W0616 "the module shifts levels";`."#,
});

/// `name` is the part's name in the file, `wires` lists the wires that the board drives, `level` is the board's
/// voltage, `most` the greatest supply of the driver's part.
pub fn driven_over_part(
    span: Span,
    (name, wires, level): (&str, &str, &str),
    (driver, most): (&str, &str),
) -> Diagnostic {
    let what = format!(
        "the board drives {wires} of `{name}` with {level}, but the supply of `{driver}` is {most} at most"
    );
    Diagnostic::new(CODE, span, what).here("over the supply of the part").help(
        "put a level shifter between them; where the module has one, write `allow W0616 \"the module shifts levels\";`",
    )
}
