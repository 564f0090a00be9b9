//! E0258: a fault of a test that there is not.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0258",
    title: "a fault of a test that there is not",
    explanation: r#"`fault no_answer of Front at 6 s for 500 ms;` breaks something for a while. The faults are those of worlds: no_answer,
bad_checksum, late, stuck_sda, hang, torn and silent of a sensor, `reset` and `garbage` of the board, which name no
device. `for` says how long it lasts; `reset` lasts 100 ms and `garbage` 20 ms without it.

Way out: write one of these, with the sensor it is about and how long it lasts."#,
});

/// No fault has that name.
pub fn unknown(span: Span, name: &str, near: Option<&str>, all: &str) -> Diagnostic {
    let report = Diagnostic::new(CODE, span, format!("there is no fault `{name}`"));
    match near {
        Some(word) => report.meant(near).help(format!("write `{word}`")),
        None => report.here("unknown").help(format!("the faults are {all}")),
    }
}

/// It is about a device, and names none.
pub fn of_what(span: Span, name: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("the fault `{name}` is of a sensor, and names none"))
        .help(format!("name the sensor: `fault {name} of Front at 1 s for 500 ms;`"))
}

/// It is about the board, and names a device.
pub fn of_board(span: Span, name: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("the fault `{name}` is of the board, not of a device"))
        .help(format!("take the device out: `fault {name} at 1 s;`"))
}

/// It is about something other than a sensor.
pub fn not_a_sensor(span: Span, name: &str, near: Option<&str>) -> Diagnostic {
    let report = Diagnostic::new(CODE, span, format!("`{name}` is not a sensor of this design"));
    match near {
        Some(word) => report.meant(near).help(format!("write `{word}`")),
        None => report.help("a fault is of a sensor, or of the board"),
    }
}

/// The sensor cannot have it.
pub fn not_of_kind(span: Span, fault: &str, device: &str, kind: &str, needs: &str) -> Diagnostic {
    let what = format!("`{device}` is on {kind}, so it cannot have the fault `{fault}`");
    Diagnostic::new(CODE, span, what).help(format!("`{fault}` is for {needs}"))
}

/// It does not say how long it lasts.
pub fn how_long(span: Span, name: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("the fault `{name}` does not say how long it lasts"))
        .help("add the time: `for 500 ms`")
}
