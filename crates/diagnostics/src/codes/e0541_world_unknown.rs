//! E0541: a world names something that does not exist.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0541",
    title: "a world names something unknown",
    explanation: r#"Under `[devices]` stand the names of the sensors of the simulated board as the `.sense` file has them. What the chip
`Climate` measures by itself is called `ClimateTemperature`, `ClimateHumidity` and so on; `sensedsl simulate FILE`
shows all names. An actuator has no line: the host sets it, and `[[command]]` says to what.

Way out: write a name or a word that there is; the message has the nearest one, or all of them."#,
});

/// No sensor of the board has this name.
pub fn unknown_device(span: Span, name: &str, near: Option<&str>, all: &str) -> Diagnostic {
    let report = Diagnostic::new(CODE, span, format!("the board has no sensor called `{name}`"));
    match near {
        Some(near) => report.here("unknown").help(format!("did you mean `{near}`?")).replace(
            format!("change to `{near}`"),
            span,
            near,
        ),
        None => report.here("unknown").help(format!("its sensors are {all}")),
    }
}

/// No actuator of the board has this name.
pub fn unknown_actuator(span: Span, name: &str, near: Option<&str>, all: &[&str]) -> Diagnostic {
    let what = format!("the board has no actuator called `{name}`");
    let report = Diagnostic::new(CODE, span, what).here("unknown");
    match near {
        Some(near) => report.help(format!("did you mean `{near}`?")).replace(
            format!("change to `{near}`"),
            span,
            near,
        ),
        None if all.is_empty() => report.help("it has none: take the command out"),
        None => report.help(format!("its actuators are {}", all.join(", "))),
    }
}

/// The device is an actuator, or on another board.
pub fn not_simulated(span: Span, name: &str, why: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{name}` {why}"))
        .help("a world says what sensors of the simulated board measure: take the line out")
}

/// A key or a word that means nothing here.
pub fn unknown_word(span: Span, word: &str, place: &str, near: Option<&str>, all: &str) -> Diagnostic {
    let report = Diagnostic::new(CODE, span, format!("`{word}` means nothing in {place}")).here("unknown");
    match near {
        Some(near) => report.help(format!("did you mean `{near}`?")),
        None => report.help(format!("there are {all}")),
    }
}
