//! E0250: a controller reads or sets what it cannot.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0250",
    title: "a controller cannot read or set that",
    explanation: r#"`reads` and `sets` of a controller name devices of its own board: sensors and actuators of the same `board` block,
those of chips included. Code sets actuators, and sensors of `type = code`; what hardware measures it can only read.

Way out: name a device of the board, or move the device into the board's block. A value that the code computes is a
sensor of its own: `sensor Error returns float32 { type = code; }`."#,
});

/// Nothing of the board has that name.
pub fn unknown_device(span: Span, name: &str, board: &str, meant: Option<&str>) -> Diagnostic {
    let diagnostic = Diagnostic::new(CODE, span, format!("`{name}` is not a device of the board `{board}`"));
    match meant {
        Some(meant) => diagnostic.here(format!("did you mean `{meant}`?")).replace(
            format!("change to `{meant}`"),
            span,
            meant,
        ),
        None => diagnostic.help("name a sensor or an actuator of the same `board` block"),
    }
}

/// The device may be on another board.
pub fn elsewhere(span: Span, name: &str, board: &str, at: Span) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{name}` need not be on the board `{board}`"))
        .label(at, "outside of that board's block")
        .help(format!("move `{name}` into the block of `{board}`"))
}

/// The name is that of a chip with several values.
pub fn chip(span: Span, name: &str, values: &[&str]) -> Diagnostic {
    let list: Vec<String> = values.iter().map(|value| format!("`{value}`")).collect();
    let message = format!("`{name}` is a chip with {} values", values.len());
    let first = values.first().copied().unwrap_or_default();
    Diagnostic::new(CODE, span, message)
        .help(format!("name what the code needs of it: {}", list.join(", ")))
        .one_of([first])
}

/// Hardware measures the value.
pub fn measured(span: Span, name: &str, at: Span) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{name}` is measured, so code cannot set it"))
        .label(at, "measured by hardware")
        .help("code sets actuators and sensors of `type = code`")
}
