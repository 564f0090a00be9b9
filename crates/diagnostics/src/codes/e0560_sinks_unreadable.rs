//! E0560: a file for `monitor --config` is not what it should be.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0560",
    title: "a configuration of `monitor` cannot be read",
    explanation: r#"`monitor --config FILE` reads a text in TOML. It has a table for each program that gets the values, and tables for
boards and devices:

    [mqtt]
    broker = "localhost:1883"

    [boards.Rover]
    rate_hz = 10

    [devices."Rover/Light"]
    topic = "garden/light"

The text is not TOML, a key is unknown, or a value is of another sort.

Way out: mend what the message points at. `sensedsl monitor --init-config FILE` prints a complete file with comments."#,
});

/// `why` is the message of the TOML parser.
pub fn not_toml(span: Span, why: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("the configuration is not TOML: {why}"))
        .help("`sensedsl monitor --init-config FILE` prints a complete one")
}

/// `place` has no such key; `all` lists those that it has.
pub fn unknown_key(span: Span, key: &str, place: &str, near: Option<&str>, all: &str) -> Diagnostic {
    let report = Diagnostic::new(CODE, span, format!("{place} has no `{key}`")).here("unknown");
    match near {
        Some(near) => report.help(format!("did you mean `{near}`?")).replace(
            format!("change to `{near}`"),
            span,
            near,
        ),
        None => report.help(format!("it has {all}")),
    }
}

/// A value of another sort is needed: `a number above 0`, `a text`.
pub fn wrong_value(span: Span, key: &str, wanted: &str, example: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{key}` must be {wanted}"))
        .here(format!("not {wanted}"))
        .help(format!("write for example `{example}`"))
}

/// A unit is not one of the device's quantity.
pub fn wrong_unit(span: Span, unit: &str, name: &str, quantity: Option<&str>) -> Diagnostic {
    let of = match quantity {
        Some(quantity) => format!("it is shown in {quantity}"),
        None => "it is shown as a bare number".to_owned(),
    };
    Diagnostic::new(CODE, span, format!("`{unit}` does not fit `{name}`: {of}"))
        .here("of another quantity")
        .help("write a unit with another prefix, or a `scale` beside this `unit`")
}

/// The file says who gets values in no table.
pub fn no_sink(span: Span, all: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, "the configuration names no program that gets the values")
        .help(format!("add a table: {all}"))
}
