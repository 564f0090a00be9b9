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

For ROS 2, `[messages.TOPIC]` puts a message together from several devices:

    [messages.battery]
    type = "BatteryState"
    voltage = "Rover/Volts"

Its keys are the fields of the message. A field is in the unit that ROS 2 asks for: a device in another one is converted
if it measures the same, and refused if not.

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

/// A message says of no type what it is; `all` lists them.
pub fn no_type(span: Span, place: &str, all: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("{place} has no `type`"))
        .help(format!("write `type = \"NAME\"` with one of {all}"))
}

/// The message type is unknown; `all` lists the known ones.
pub fn unknown_type(span: Span, name: &str, near: Option<&str>, all: &str) -> Diagnostic {
    let report = Diagnostic::new(CODE, span, format!("no message is put together as `{name}`")).here("unknown");
    match near {
        Some(near) => report.help(format!("did you mean `{near}`?")),
        None => report.help(format!("there are {all}")),
    }
}

/// A message needs a field.
pub fn lacks(span: Span, place: &str, field: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("{place} has no `{field}`"))
        .here("incomplete")
        .help(format!("name devices for `{field}`"))
}

/// Two lists must have the same length.
pub fn other_count(span: Span, (one, found): (&str, usize), (other, wanted): (&str, usize)) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{one}` has {found} entries, and `{other}` has {wanted}"))
        .help(format!("name as many in `{one}` as in `{other}`, or leave it out"))
}

/// An entry is not the one number, or the three, that a field takes. `length` is that of an array.
pub fn wrong_element(span: Span, entry: &str, name: &str, length: Option<usize>, takes_array: bool) -> Diagnostic {
    let has = match length {
        Some(length) => format!("`{name}` is an array of {length}"),
        None => format!("`{name}` is no array"),
    };
    let help = match length {
        _ if takes_array => "name an array of three, or a list of three devices".to_owned(),
        Some(length) => format!("name one of `{name}[0]` to `{name}[{}]`", length.saturating_sub(1)),
        None => format!("write `{name}`"),
    };
    Diagnostic::new(CODE, span, format!("`{entry}` does not fit: {has}")).here("does not fit").help(help)
}

/// A field takes numbers and the device is on or off, or the other way round.
pub fn wrong_sort(span: Span, name: &str, field: &str, is_flag: bool) -> Diagnostic {
    let (is, takes) = if is_flag { ("a `bool`", "numbers") } else { ("a number", "what is a `bool`") };
    Diagnostic::new(CODE, span, format!("`{name}` is {is}, and `{field}` takes {takes}"))
        .here(format!("is {is}"))
        .help("name another device")
}

/// A device measures something else than a field has.
pub fn other_unit(span: Span, (field, wanted): (&str, &str), name: &str, unit: Option<&str>) -> Diagnostic {
    let wanted = if wanted == "1" { "a number from 0 to 1, or in %" } else { wanted };
    let has = match unit {
        Some(unit) => format!("`{name}` is in {unit}"),
        None => format!("`{name}` is a bare number"),
    };
    Diagnostic::new(CODE, span, format!("{has}, and `{field}` needs {wanted}"))
        .here("measures something else")
        .help(format!("name a device in such a unit, or write `unit` and `scale` in `[devices.\"{name}\"]`"))
}
