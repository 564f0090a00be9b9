//! E0557: there is no board to monitor.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0557",
    title: "no board to monitor",
    explanation: r#"`monitor` needs a board and the design that it was made for. The device cannot be opened, no device of this machine
answers as a board of the design does, or the call does not say which design is meant.

Way out: plug the board in and name its device (`/dev/ttyACM0`, `COM3`), with the file of the design behind it. A device
that another program has open must be closed there; one that belongs to a group asks for membership in it."#,
});

/// A device cannot be opened; `cure` says what helps.
pub fn not_opened(span: Span, device: &str, why: &str, cure: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("cannot open {device}: {why}")).help(cure)
}

/// A recording cannot be read.
pub fn unreadable(span: Span, file: &str, why: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("cannot read {file}: {why}"))
        .help("name a serial port, a file with a board's bytes, `-`, or `simulate`")
}

/// No USB port has a board of the design; `tried` says what is on each.
pub fn none_found(span: Span, tried: &[String]) -> Diagnostic {
    let what = "no USB port has a board of this design";
    let what = if tried.is_empty() { what.to_owned() } else { format!("{what} ({})", tried.join("; ")) };
    Diagnostic::new(CODE, span, what)
        .help("plug it in, or name its device: `sensedsl monitor /dev/ttyACM0 FILE`; `sensedsl monitor simulate FILE` needs no board")
}

/// Neither a design nor a schema was named.
pub fn no_design(span: Span) -> Diagnostic {
    Diagnostic::new(CODE, span, "nobody says which design the board is of")
        .help("name its file: `sensedsl monitor DEVICE FILE`, or its schema: `--schema DIR/schema.json`")
}

/// No board of the design carries a device.
pub fn nothing_on_it(span: Span) -> Diagnostic {
    Diagnostic::new(CODE, span, "no board of this design has a device to watch")
        .help("declare a sensor or an actuator")
}
