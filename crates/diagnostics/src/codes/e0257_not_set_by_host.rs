//! E0257: a test sets what the host cannot set.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0257",
    title: "the host of a test cannot set that",
    explanation: r#"`at 1 s set Speed = 30 %;` is what a host does: it sets an actuator. What a sensor measures is in the world, and an
actuator that a controller sets refuses the host, unless the controller has `host = override;`.

Way out: set an actuator, often a parameter (`actuator Speed accepts float32 { type = code; }`) that the controller
reads; say in the world what sensors measure."#,
});

/// A sensor.
pub fn sensor(span: Span, name: &str, at: Span) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{name}` is a sensor, so the host cannot set it"))
        .label(at, "measured by the board")
        .help("write in the world what it measures, and name the world here: `world = \"worlds/hot.toml\";`")
}

/// An actuator that belongs to a controller.
pub fn owned(span: Span, name: &str, controller: &str, at: Span) -> Diagnostic {
    let message = format!("`{name}` is set by the controller `{controller}`, which refuses the host");
    Diagnostic::new(CODE, span, message)
        .label(at, "set here")
        .help(format!("set what `{controller}` reads, or give it `host = override;`"))
}

/// Nothing has that name.
pub fn unknown(span: Span, name: &str, near: Option<&str>) -> Diagnostic {
    let report = Diagnostic::new(CODE, span, format!("`{name}` is not an actuator of this design"));
    match near {
        Some(word) => report.meant(near).help(format!("write `{word}`")),
        None => report.here("unknown").help("set an actuator of the design"),
    }
}
